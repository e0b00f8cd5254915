// Where in a run a check is to be seen: its part as people call it, a joint to choose, the row at which its number is largest.
import type { Check, Meta, Part } from "./format";
import type { Run } from "./panel";

export const dockName = (module: string): string => `${module}'s dock`;

/** Joints and bodies by their names, docks as `m5's dock`, feet by their legs. */
export function partName(meta: Meta, part: Part, name: string): string {
  if (part === "dock") return dockName(name);
  return part === "foot" ? meta.feet.find((f) => f.name === name)?.title ?? name : name;
}

/** The number of a joint, or of the one next to a body, a foot or a dock; -1: there is none. */
export function jointAt({ joints, bodies, modules }: Meta, part: Part, name: string | null): number {
  if (name === null) return -1;
  if (part === "joint") return joints.findIndex((j) => j.name === name);
  const body = bodies.findIndex((b) => b.name === name), own = body < 0 ? -1 : joints.findIndex((j) => j.body === body);
  const module = part === "dock" ? modules.findIndex((m) => m.name === name) : bodies[body]?.module ?? -1;
  return own >= 0 ? own : joints.findIndex((j) => j.module === module);
}

/** The number of a dock; -1: the part is none. */
export const dockAt = ({ docks }: Meta, part: Part, name: string | null): number => (part === "dock" ? docks.findIndex((d) => d.name === name) : -1);

type Measure = (row: number) => number;

/** What a check is of, row by row, largest where it is to be seen; null: no channel of the page shows it. */
function measure({ recording, loads }: Run, { id, part }: Check, name: string | null): Measure | null {
  const { joints } = recording.meta;
  if (part === "dock") {
    const kind = id.slice("dock_".length), loaded = recording.find(`dock.${dockAt(recording.meta, part, name)}.${kind}`);
    return loaded && ((i) => (kind === "tension" ? loaded[i] : Math.abs(loaded[i])));
  }
  const j = part === "joint" ? jointAt(recording.meta, part, name) : -1;
  if (j < 0) return null;
  const { lo, hi } = joints[j], of = (quantity: string) => recording.find(`joint.${j}.${quantity}`), setpoint = of("setpoint"), angle = of("angle");
  const size = (quantity: string): Measure | null => {
    const values = of(quantity);
    return values && ((i) => Math.abs(values[i]));
  };
  const beyond = (values: typeof angle): Measure | null => values && ((i) => Math.max(values[i] - (hi ?? Infinity), (lo ?? -Infinity) - values[i]));
  const torque = size("torque"), saturated = of("saturation"), share = loads.limited ? loads.share(j) : null;
  const measures: Record<string, Measure | null> = {
    voltage: saturated && ((i) => Math.sign(saturated[i])), envelope: share && ((i) => share[i]), speed: size("speed"), heat: size("current"), gear_peak: torque, gear_continuous: torque,
    tracking: setpoint && angle && ((i) => Math.abs(setpoint[i] - angle[i])), stops: beyond(angle), setpoints: beyond(setpoint),
  };
  return measures[id === "current" ? "voltage" : id] ?? null;
}

/** s: of the rows from one time to another that at which something is largest, of equal ones that in the middle; without a row between them the one next to them. */
function largestRow({ recording: { times, rows } }: Run, of: Measure, from: number, to: number): number {
  const within: number[] = [];
  let nearest = 0;
  for (let i = 0; i < rows; i++) {
    const t = times[i], middle = (from + to) / 2;
    if (Math.abs(t - middle) < Math.abs(times[nearest] - middle)) nearest = i;
    if (t > from - 1e-6 && t < to + 1e-6) within.push(i);
  }
  const most = within.reduce((a, i) => Math.max(a, of(i)), -Infinity), equal = within.filter((i) => of(i) === most);
  return times[equal[equal.length >> 1] ?? nearest];
}

/** s: the row at which the worst part of a check is worst; null: the check is of no time. */
export function moment(run: Run, check: Check): number | null {
  const { window } = run.recording.meta.verdict, of = measure(run, check, check.worst), { from } = check;
  if (!of) return check.id === "outcome" && check.status === "fail" ? run.recording.end : from;
  const all = check.span === "window" ? window : { from: 0, to: run.recording.end };
  return from === null ? largestRow(run, of, all.from, all.to) : largestRow(run, of, from, check.to ?? from);
}

/** s: the row at which a check first was beyond its limit; null: it never was, or nobody knows when. */
export function firstMoment(run: Run, check: Check): number | null {
  const { first, first_part: part } = check, of = first === null ? null : measure(run, check, part);
  if (first === null || !of) return first;
  // Within the control ticks that follow.
  return largestRow(run, of, first, first + Math.max(0.02, run.recording.meta.period));
}

/** s: the middle of the longest stretch of rows in which a joint is at a limit of its motor, in the judged window. */
export function longestMoment({ recording }: Run, joint: number): number | null {
  const at = recording.find(`joint.${joint}.saturation`);
  let best = 0, middle: number | null = null, length = 0;
  for (let i = recording.judged; at && i < at.length; i++) {
    length = at[i] > 0 ? length + 1 : 0;
    if (length <= best) continue;
    best = length;
    middle = recording.times[i - (length >> 1)];
  }
  return middle;
}

/** Chooses the joint of a part, marks the dock that it is, and goes to a time, where there are such. */
export function show(run: Run, part: Part, name: string | null, t: number | null): void {
  const joint = jointAt(run.recording.meta, part, name);
  if (joint >= 0) run.choose(joint);
  run.mark(dockAt(run.recording.meta, part, name));
  if (t !== null) run.goTo(t);
}
