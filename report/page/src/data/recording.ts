// Recording of a run, read from the page: the description of the run (meta), and the channels over time.
import { inflate, unpack, type Values } from "./channels";
import type { Channel, Meta } from "./format";

export type Span = [from: number, to: number];

/** Second run of the page, and the differences from the first run by signal. */
export interface Second {
  recording: Recording;
  differences: ReadonlyMap<string, Values>;
}

export class Recording {
  readonly times: Float64Array;

  constructor(
    readonly meta: Meta,
    private readonly channels: ReadonlyMap<string, Values>,
  ) {
    for (const [name, known] of channels) {
      if (name.endsWith(".known")) {
        channels.get(name.slice(0, -6))?.forEach((_, i, values) => {
          if (!known[i]) values[i] = NaN;
        });
      }
    }
    const t = channels.get("t");
    this.times = Float64Array.from({ length: Math.max(meta.rows, 1) }, (_, i) => t?.[i] ?? i * meta.period);
    // A channel of 32-bit floats has only 7 digits. The time of a row on the grid is thus computed from its number.
    this.times.forEach((time, i) => {
      if (Math.abs(time - i * meta.period) < 1e-3 * meta.period) this.times[i] = i * meta.period;
    });
  }

  /** Reads the first run of a page, and its second run if there is one. */
  static async of(page: Document): Promise<[Recording, Second | null]> {
    const text = (id: string) => page.getElementById(id)?.textContent?.trim() ?? "";
    const meta = JSON.parse(text("meta")) as Meta;
    const data = text("data").split("\n");
    const format: number = meta.format; // differs from 1 if another version of the program wrote the page
    if (format !== 1) throw new Error(`it is of format ${format}, this page reads format 1`);
    const values = async (channels: Channel[], packed: string) =>
      unpack(channels, channels.length ? await inflate(packed) : new Uint8Array());
    const read = async (of: Meta, packed: string) => new Recording(of, await values(of.channels, packed));
    const { overlay } = meta;
    return [
      await read(meta, data[0]),
      overlay
        ? { recording: await read(overlay.run, data[1]), differences: await values(overlay.differences, data[2]) }
        : null,
    ];
  }

  get rows(): number {
    return this.times.length;
  }
  get end(): number {
    return this.times[this.rows - 1];
  }
  get ran(): boolean {
    return this.meta.outcome !== "not run" && this.rows > 1;
  }

  has(name: string): boolean {
    return this.channels.has(name);
  }
  /** True if a quantity is recorded for any joint. Hinges without a motor have no set point, torque and current. */
  any(quantity: string): boolean {
    return this.meta.joints.some((_, j) => this.has(`joint.${j}.${quantity}`));
  }
  find(name: string): Values | null {
    return this.channels.get(name) ?? null;
  }
  /** Values of a channel; zeros if it is not recorded. */
  channel(name: string): Values {
    return this.channels.get(name) ?? (this.zeros ??= new Float32Array(this.rows));
  }
  private zeros?: Values;

  /** The last row at or before t. */
  row(t: number): number {
    let i = Math.min(Math.max(Math.floor(t / this.meta.period + 1e-6), 0), this.rows - 1);
    while (i > 0 && this.times[i] > t + 1e-9) i--;
    return i;
  }

  /** Rows at the edges of `count` columns of pixels. */
  columns([from, to]: Span, count: number): number[] {
    return Array.from({ length: count + 1 }, (_, x) => this.row(from + ((to - from) * x) / count));
  }

  /** Value at time t, interpolated linearly between rows. */
  at(values: Values, t: number): number {
    const i = this.row(t);
    if (i + 1 >= this.rows) return values[i];
    const share = Math.min(Math.max((t - this.times[i]) / (this.times[i + 1] - this.times[i]), 0), 1);
    return values[i] * (1 - share) + values[i + 1] * share;
  }

  /** The first row of the judged window. */
  get judged(): number {
    return this.row(this.meta.verdict.window.from);
  }
  /** The first row of the last period; without a limit cycle, of the judged window. */
  get lastPeriod(): number {
    const { cycle } = this.meta;
    return cycle ? Math.max(this.judged, this.row(this.end - cycle.period)) : this.judged;
  }
}
