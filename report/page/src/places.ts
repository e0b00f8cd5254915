// Place of a check in a run: the name of its part, its joint or dock, and the time of its largest value.
import type { Check, Meta, Part } from "./format";
import type { Run } from "./panel";

export const dockName = (module: string): string => `${module}'s dock`;

/** Name of a part: joints and bodies by their names, docks as `m5's dock`, feet by their legs. */
export function partName(meta: Meta, part: Part, name: string): string {
  if (part === "dock") return dockName(name);
  return part === "foot" ? (meta.feet.find((f) => f.name === name)?.title ?? name) : name;
}

/** Number of a joint, or of the joint next to a body, foot or dock; -1: none. */
export function jointAt({ joints, bodies, modules }: Meta, part: Part, name: string | null): number {
  if (name === null) return -1;
  if (part === "joint") return joints.findIndex((j) => j.name === name);
  const body = bodies.findIndex((b) => b.name === name);
  const own = body < 0 ? -1 : joints.findIndex((j) => j.body === body);
  const module = part === "dock" ? modules.findIndex((m) => m.name === name) : (bodies[body]?.module ?? -1);
  return own >= 0 ? own : joints.findIndex((j) => j.module === module);
}

/** Number of a dock; -1 for other parts. */
export const dockAt = ({ docks }: Meta, part: Part, name: string | null): number =>
  part === "dock" ? docks.findIndex((d) => d.name === name) : -1;

type Measure = (row: number) => number;

/** Quantity of a check by rows, largest at the worst row; null: the page has no channel of it. */
function measure({ recording, loads }: Run, { id, part }: Check, name: string | null): Measure | null {
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
    voltage: saturated && ((i) => Math.sign(saturated[i])),
    envelope: share && ((i) => share[i]),
    speed: size("speed"),
    heat: size("current"),
    gear_peak: torque,
    gear_continuous: torque,
    tracking: setpoint && angle && ((i) => Math.abs(setpoint[i] - angle[i])),
    stops: beyond(angle),
    setpoints: beyond(setpoint),
  };
  return measures[id === "current" ? "voltage" : id] ?? null;
}

/**
 * Time of the row with the largest measure between two times, s; the middle one of equal rows. Without a row between
 * the times, the time of the nearest row.
 */
function largestRow({ recording: { times, rows } }: Run, of: Measure, from: number, to: number): number {
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

/** Time of the worst row of the worst part of a check, s; null: the check does not refer to a time. */
export function moment(run: Run, check: Check): number | null {
  const { window } = run.recording.meta.verdict;
  const of = measure(run, check, check.worst);
  const { from } = check;
  if (!of) return check.id === "outcome" && check.status === "fail" ? run.recording.end : from;
  const all = check.span === "window" ? window : { from: 0, to: run.recording.end };
  return from === null ? largestRow(run, of, all.from, all.to) : largestRow(run, of, from, check.to ?? from);
}

/** Time of the first row beyond the limit of a check, s; null: there is none, or it is unknown. */
export function firstMoment(run: Run, check: Check): number | null {
  const { first, first_part: part } = check;
  const of = first === null ? null : measure(run, check, part);
  if (first === null || !of) return first;
  // The row follows within a few control ticks.
  return largestRow(run, of, first, first + Math.max(0.02, run.recording.meta.period));
}

/** Middle of the longest time of a joint at a limit of its motor, in the judged window; s. */
export function longestMoment({ recording }: Run, joint: number): number | null {
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

/** Shows a part and a time: selects its joint, marks its dock, if it has one. */
export function show(run: Run, part: Part, name: string | null, t: number | null): void {
  const joint = jointAt(run.recording.meta, part, name);
  if (joint >= 0) run.choose(joint);
  run.mark(dockAt(run.recording.meta, part, name));
  if (t !== null) run.goTo(t);
}
