// A run as the page reads it: what the program says of it, and its channels over time.
import { inflate, unpack, type Values } from "./channels";
import type { Channel, Meta } from "./format";

/** The run that is laid over the page's own. */
export interface Second {
  recording: Recording;
  differences: ReadonlyMap<string, Values>;
}

export class Recording {
  readonly times: Float64Array;

  constructor(readonly meta: Meta, private readonly channels: ReadonlyMap<string, Values>) {
    for (const [name, known] of channels) {
      if (name.endsWith(".known")) channels.get(name.slice(0, -6))?.forEach((_, i, values) => { if (!known[i]) values[i] = NaN; });
    }
    const t = channels.get("t");
    this.times = Float64Array.from({ length: Math.max(meta.rows, 1) }, (_, i) => t?.[i] ?? i * meta.period);
    // A channel in 32 bits has 7 digits: where a row stands on the grid, the grid knows its time better.
    this.times.forEach((time, i) => { if (Math.abs(time - i * meta.period) < 1e-3 * meta.period) this.times[i] = i * meta.period; });
  }

  /** The runs of a page: its own, and the one that is laid over it where there is one, with what they differ by. */
  static async of(page: Document): Promise<[Recording, Second | null]> {
    const text = (id: string) => page.getElementById(id)?.textContent?.trim() ?? "";
    const meta = JSON.parse(text("meta")) as Meta, data = text("data").split("\n");
    if (meta.format !== 1) throw new Error(`it is of format ${meta.format}, this page reads format 1`);
    const values = async (channels: Channel[], packed: string) => unpack(channels, channels.length ? await inflate(packed) : new Uint8Array());
    const read = async (of: Meta, packed: string) => new Recording(of, await values(of.channels, packed)), { overlay } = meta;
    return [await read(meta, data[0]), overlay ? { recording: await read(overlay.run, data[1]), differences: await values(overlay.differences, data[2]) } : null];
  }

  get rows(): number { return this.times.length; }
  get end(): number { return this.times[this.rows - 1]; }
  get ran(): boolean { return this.meta.outcome !== "not run" && this.rows > 1; }

  has(name: string): boolean { return this.channels.has(name); }
  /** Whether any joint has it: hinges without a motor have no set point, torque and current. */
  any(quantity: string): boolean { return this.meta.joints.some((_, j) => this.has(`joint.${j}.${quantity}`)); }
  find(name: string): Values | null { return this.channels.get(name) ?? null; }
  /** Zeros where the recording has no such channel. */
  channel(name: string): Values { return this.channels.get(name) ?? (this.zeros ??= new Float32Array(this.rows)); }
  private zeros?: Values;

  /** The last row that is not after t. */
  row(t: number): number {
    let i = Math.min(Math.max(Math.floor(t / this.meta.period + 1e-6), 0), this.rows - 1);
    while (i > 0 && this.times[i] > t + 1e-9) i--;
    return i;
  }

  /** At time t, straight between rows. */
  at(values: Values, t: number): number {
    const i = this.row(t);
    if (i + 1 >= this.rows) return values[i];
    const share = Math.min(Math.max((t - this.times[i]) / (this.times[i + 1] - this.times[i]), 0), 1);
    return values[i] * (1 - share) + values[i + 1] * share;
  }

  /** The first row of the judged window. */
  get judged(): number { return this.row(this.meta.verdict.window.from); }
}
