// Place of a check in a run: the name of the worst part, its joint or dock, and the time of the largest value.
import type { Check, Meta, Part } from "./format";
import type { Loads } from "./loads";
import type { Recording } from "./recording";

/** Recording of a run, and the loads of its joints. */
export interface Measured {
  readonly recording: Recording;
  readonly loads: Loads;
}

/** Share of the weight, and of the mean load of a foot, that a foot on the ground bears at least. */
const least = { weight: 0.02, mean: 0.2 };
export const many = ({ feet }: Meta): boolean => feet.length * least.weight > least.mean;
/** Least load of a foot on the ground, N. With many feet, each bears a small share of the weight. */
export const leastLoad = (meta: Meta): number =>
  many(meta) ? (least.mean * meta.weight) / meta.feet.length : least.weight * meta.weight;

export const dockName = (module: string): string => `${module}'s dock`;

/** Name of a part in texts: for a dock `m5's dock`, for a foot the name of its leg, for other parts their own name. */
export function partName(meta: Meta, part: Part, name: string): string {
  if (part === "dock") return dockName(name);
  return part === "foot" ? (meta.feet.find((f) => f.name === name)?.title ?? name) : name;
}

/** Number of a joint, or of a joint next to a body, foot or dock; -1 if there is none. */
export function jointAt({ joints, bodies, modules }: Meta, part: Part, name: string | null): number {
  if (name === null) return -1;
  if (part === "joint") return joints.findIndex((j) => j.name === name);
  const body = bodies.findIndex((b) => b.name === name);
  const own = body < 0 ? -1 : joints.findIndex((j) => j.body === body);
  const module = part === "dock" ? modules.findIndex((m) => m.name === name) : (bodies[body]?.module ?? -1);
  return own >= 0 ? own : joints.findIndex((j) => j.module === module);
}

/** Number of a dock; -1 if the part is not a dock. */
export const dockAt = ({ docks }: Meta, part: Part, name: string | null): number =>
  part === "dock" ? docks.findIndex((d) => d.name === name) : -1;

type Measure = (row: number) => number;

/** Function from a row to a measure of a check that is largest at the worst row; null without a suitable channel. */
function measure({ recording, loads }: Measured, { id, part }: Check, name: string | null): Measure | null {
  const { joints } = recording.meta;
  if (part === "dock") {
    const kind = id.slice("dock_".length);
    const loaded = recording.find(`dock.${dockAt(recording.meta, part, name)}.${kind}`);
    return loaded && ((i) => (kind === "tension" ? loaded[i] : Math.abs(loaded[i])));
  }
  const j = part === "joint" ? jointAt(recording.meta, part, name) : -1;
  if (j < 0) return null;
  const { lo, hi } = joints[j];
  const of = (quantity: string) => recording.find(`joint.${j}.${quantity}`);
  const setpoint = of("setpoint");
  const angle = of("angle");
  const size = (quantity: string): Measure | null => {
    const values = of(quantity);
    return values && ((i) => Math.abs(values[i]));
  };
  const beyond = (values: typeof angle): Measure | null =>
    values && ((i) => Math.max(values[i] - (hi ?? Infinity), (lo ?? -Infinity) - values[i]));
  const torque = size("torque");
  const saturated = of("saturation");
  const share = loads.limited ? loads.share(j) : null;
  const measures: Record<string, Measure | null> = {
    voltage: saturated && ((i) => Number(saturated[i] === 1)),
    current: saturated && ((i) => Number(saturated[i] === 2)),
    envelope: share && ((i) => share[i]),
    speed: size("speed"),
    heat: size("current"),
    gear_peak: torque,
    gear_continuous: torque,
    tracking: setpoint && angle && ((i) => Math.abs(setpoint[i] - angle[i])),
    stops: beyond(angle),
    setpoints: beyond(setpoint),
  };
  return measures[id] ?? null;
}

/**
 * Time of the row with the largest measure between two times, s. Among rows with equal measures, the middle row counts.
 * If there is no row between the times, the result is the time of the row nearest to their middle.
 */
function largestRow({ recording: { times, rows } }: Measured, of: Measure, from: number, to: number): number {
  const within: number[] = [];
  let nearest = 0;
  for (let i = 0; i < rows; i++) {
    const t = times[i];
    const middle = (from + to) / 2;
    if (Math.abs(t - middle) < Math.abs(times[nearest] - middle)) nearest = i;
    if (t > from - 1e-6 && t < to + 1e-6) within.push(i);
  }
  const most = within.reduce((a, i) => Math.max(a, of(i)), -Infinity);
  const equal = within.filter((i) => of(i) === most);
  return times[equal[equal.length >> 1] ?? nearest];
}

/** Time of the worst row of the worst part of a check, s; null if the check does not refer to a time. */
export function moment(run: Measured, check: Check): number | null {
  const { window } = run.recording.meta.verdict;
  const of = measure(run, check, check.worst);
  const { from } = check;
  if (!of) return check.id === "outcome" && check.status === "fail" ? run.recording.end : from;
  const all = check.span === "window" ? window : { from: 0, to: run.recording.end };
  return from === null ? largestRow(run, of, all.from, all.to) : largestRow(run, of, from, check.to ?? from);
}

/** Time of the first row beyond the limit of a check, s; null if no row is beyond the limit or the time is unknown. */
export function firstMoment(run: Measured, check: Check): number | null {
  const { first, first_part: part } = check;
  const of = first === null ? null : measure(run, check, part);
  if (first === null || !of) return first;
  // The first row beyond the limit follows the exact time `first` within a few control ticks.
  return largestRow(run, of, first, first + Math.max(0.02, run.recording.meta.period));
}

/**
 * True if the joint that is first at a limit of its motor is at this limit in every whole period from then to the end
 * of the run, which has at least two of them. Parts of other checks may have other limits, so that this is not known.
 */
export function everyPeriod(run: Measured, check: Check): boolean {
  const { meta, times, end } = run.recording;
  const { id, first, first_part } = check;
  const of = id === "voltage" || id === "current" ? measure(run, check, first_part) : null;
  const period = meta.cycle?.period ?? (meta.frequency ? 1 / meta.frequency : Infinity);
  const count = Math.floor((end - (first ?? end)) / period + 1e-6);
  if (!of || first === null || count < 2) return false;
  const met = new Set<number>();
  times.forEach((t, i) => {
    if (of(i)) met.add(Math.floor((t - first) / period));
  });
  return Array.from({ length: count }, (_, k) => k).every((k) => met.has(k));
}

/** Middle of the longest interval in the judged window in which a joint is at a limit of its motor, s. */
export function longestMoment({ recording }: Measured, joint: number): number | null {
  const at = recording.find(`joint.${joint}.saturation`);
  let best = 0;
  let middle: number | null = null;
  let length = 0;
  for (let i = recording.judged; at && i < at.length; i++) {
    length = at[i] > 0 ? length + 1 : 0;
    if (length <= best) continue;
    best = length;
    middle = recording.times[i - (length >> 1)];
  }
  return middle;
}
