// Second run of the page. Panels use times, and numbers of joints, feet and docks, of the first run; this file converts
// these to the second run.
import type { Values } from "./channels";
import type { Overlay, Stray } from "./format";
import { Loads } from "./loads";
import { fixed } from "./numbers";
import { dockName } from "./places";
import type { Recording, Second } from "./recording";

type Kind = "joint" | "foot" | "dock";

export class Ghost {
  readonly loads: Loads;
  readonly overlay: Overlay;
  private phase = false;
  /** Numbers in the second run, by number in the first run; -1 if the second run has no part of that name. */
  private readonly numbers: Record<Kind, number[]>;
  private readonly known = new Map<string, Values | null>();

  readonly recording: Recording;

  constructor(
    private readonly second: Second,
    private readonly own: Recording,
  ) {
    const { recording } = second;
    this.recording = recording;
    this.overlay = own.meta.overlay!;
    this.loads = new Loads(recording);
    const { joints, feet, docks } = own.meta;
    const places = (ours: { name: string }[], theirs: { name: string }[]) =>
      ours.map(({ name }) => theirs.findIndex((one) => one.name === name));
    this.numbers = {
      joint: places(joints, recording.meta.joints),
      foot: places(feet, recording.meta.feet),
      dock: places(docks, recording.meta.docks),
    };
  }

  /** Number in the second run of a joint, foot or dock of the first run; -1 if the second run does not have it. */
  number(kind: Kind, ours: number): number {
    return this.numbers[kind][ours] ?? -1;
  }

  /** Index in the first run for a joint of the second run; -1 if the first run lacks the joint. */
  jointBack(theirs: number): number {
    return this.numbers.joint.indexOf(theirs);
  }

  get label(): string {
    return this.overlay.labels[1];
  }

  /** True if both runs have a limit cycle and can therefore be shown at the same phase. */
  get periodic(): boolean {
    return this.reference >= 0;
  }
  get aligned(): boolean {
    return this.phase;
  }
  set aligned(on: boolean) {
    this.phase = on && this.periodic;
    this.known.clear();
  }

  /** Time in the second run that the page shows at its time t, s. */
  time(t: number): number {
    return this.phase ? this.map(this.own, this.recording, t) : t;
  }
  /** Time of the page at which the second run shows its time t, s. */
  back(t: number): number {
    return this.phase ? this.map(this.recording, this.own, t) : t;
  }
  /** True if the second run has data for a time of the page. */
  covers(t: number): boolean {
    const own = this.time(t);
    return own > -1e-9 && own < this.recording.end + 1e-6;
  }

  /**
   * Channel of the second run at the rows of the first run. The name uses the first run's numbers. Values after the end
   * of the second run are NaN. Null if the second run does not have the channel.
   */
  values(name: string): Values | null {
    const known = this.known.get(name);
    if (known !== undefined) return known;
    const [kind, number, ...rest] = name.split(".");
    const theirs = kind in this.numbers ? this.number(kind as Kind, Number(number)) : null;
    const found =
      theirs === null
        ? this.recording.find(name)
        : theirs < 0
          ? null
          : this.recording.find([kind, theirs, ...rest].join("."));
    const made = found ? this.atRows(found) : null;
    this.known.set(name, made);
    return made;
  }

  /** Values of the second run, interpolated at the rows of the first run; NaN after the end of the second run. */
  atRows(values: Values): Values {
    return Float32Array.from(this.own.times, (t) => (this.covers(t) ? this.recording.at(values, this.time(t)) : NaN));
  }

  /** Difference of a signal from the golden at its rows, with a finer resolution than channels have. */
  difference(signal: string): Values | null {
    return this.second.differences.get(signal) ?? null;
  }

  /** Deviation of a signal that left its band; null if the signal stayed in its band. */
  stray(signal: string): Stray | null {
    return this.overlay.strays.find((s) => s.signal === signal) ?? null;
  }

  /** Sentences on the parts and times that only one of the runs has. */
  get apart(): string[] {
    const { own, recording } = this;
    const [a, b] = this.overlay.labels;
    const told: string[] = [];
    const count = (
      kind: Kind,
      nouns: [one: string, many: string],
      ours: { name: string }[],
      theirs: { name: string }[],
    ) => {
      const common = this.numbers[kind].filter((n) => n >= 0).length;
      const few = (names: string[]) =>
        names.length > 4 ? `${names.slice(0, 4).join(", ")} and ${names.length - 4} more` : names.join(", ");
      const lone = (all: { name: string }[], others: { name: string }[]) =>
        all.filter(({ name }) => !others.some((one) => one.name === name)).map(({ name }) => name);
      const onlyA = lone(ours, theirs);
      const onlyB = lone(theirs, ours);
      if (!onlyA.length && !onlyB.length) return;
      const parts = [
        ...(onlyA.length ? [`${a} alone has ${few(onlyA)}`] : []),
        ...(onlyB.length ? [`${b} alone has ${few(onlyB)}`] : []),
      ];
      const many = common ? `${common} ${nouns[common === 1 ? 0 : 1]}` : `no ${nouns[0]}`;
      told.push(`They have ${many} in common: ${parts.join("; ")}.`);
    };
    const called = ({ name }: { name: string }) => ({ name: dockName(name) });
    count("joint", ["joint", "joints"], own.meta.joints, recording.meta.joints);
    if (own.meta.feet.length && recording.meta.feet.length) {
      count("foot", ["foot", "feet"], own.meta.feet, recording.meta.feet);
    }
    count("dock", ["dock", "docks"], own.meta.docks.map(called), recording.meta.docks.map(called));
    if (recording.end < own.end - 1e-6) told.push(`${b} ends at ${fixed(recording.end, 2)} s, before ${a}.`);
    if (recording.end > own.end + 1e-6) {
      told.push(`${b} continues to ${fixed(recording.end, 2)} s; this page ends with ${a}, at ${fixed(own.end, 2)} s.`);
    }
    return told;
  }

  // Joint whose phase defines the common phase of the runs: the first joint that oscillates in both limit cycles; -1 if
  // there is none.
  private get reference(): number {
    const { own, recording } = this;
    const swings = (of: Recording, j: number) =>
      (of.meta.phases[j]?.setpoint[0] ?? 0) > 0.2 * Math.max(...of.meta.phases.map((p) => p.setpoint[0]), 1e-9);
    if (!own.meta.cycle || !recording.meta.cycle) return -1;
    return own.meta.joints.findIndex(
      (_, j) => this.number("joint", j) >= 0 && swings(own, j) && swings(recording, this.number("joint", j)),
    );
  }

  // Converts a time of the run `from` to the time of the run `to` at the same phase. The number of periods between the
  // times is chosen so that the times are nearest to one another when both limit cycles have begun.
  private map(from: Recording, to: Recording, t: number): number {
    const j = this.reference;
    const k = this.number("joint", j);
    const number = (r: Recording) => (r === this.own ? j : k);
    const turns = (r: Recording, time: number) =>
      time / r.meta.cycle!.period + r.meta.phases[number(r)].setpoint[1] / (2 * Math.PI);
    const back = (r: Recording, n: number) =>
      (n - r.meta.phases[number(r)].setpoint[1] / (2 * Math.PI)) * r.meta.cycle!.period;
    const begun = Math.max(this.own.meta.cycle!.from, this.recording.meta.cycle!.from);
    const whole = Math.round(turns(this.recording, begun) - turns(this.own, begun));
    return back(to, turns(from, t) + (to === this.own ? -whole : whole));
  }
}
