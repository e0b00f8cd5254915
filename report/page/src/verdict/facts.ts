// Main numbers on the card of a run: the missing torque or voltage of an infeasible gait, otherwise the tightest check
// and the motion.
import type { Check, Meta } from "../data/format";
import { inSentence, number, percent, quantity, span, time } from "../data/numbers";
import type { Run } from "../panel";
import { place } from "./place";
import { jointAt, longestMoment, moment, partName } from "../data/places";

export type Fact = [name: string, value: Node | string, small?: string];

/** Check that the torques are within the envelopes of the motors; null if this check was not judged. */
export const hardest = (meta: Meta): Check | null =>
  meta.verdict.checks.find(
    (c) => c.id === "envelope" && c.status !== "not judged" && c.value !== null && c.worst !== null,
  ) ?? null;

const limitOf = ({ limit, unit, least }: Check): string => `limit ${least ? "≥ " : ""}${quantity(limit, unit)}`;
const held = (check: Check): string => `${quantity(check.value, check.unit)}, ${limitOf(check)}`;

/**
 * Facts of an infeasible gait, the same as on the terminal and in the figure: the part that exceeds the limit of the
 * failed check most, the joint that is at a limit of its motor for the largest share of the judged time, when, and the
 * missing amount.
 */
export const shortfall = (run: Run, first: Check, failed: Check[]): Fact[] => [
  ...worst(run, first),
  ...longest(run, first),
  ...when(run, first),
  ...missing(first, failed),
];

const ofMotor = ({ id }: Check): boolean => id === "voltage" || id === "current";

function worst(run: Run, check: Check): Fact[] {
  if (check.worst !== null) return [["Worst", place(run, check.part, check.worst, moment(run, check)), held(check)]];
  return check.value === null ? [] : [["Worst", quantity(check.value, check.unit), limitOf(check)]];
}

function longest(run: Run, check: Check): Fact[] {
  const { meta } = run.recording;
  const { longest: most } = meta.verdict;
  if (!ofMotor(check) || !most) return [];
  const kinds = (["voltage", "current"] as const)
    .filter((kind) => most[kind] > 0)
    .map((kind) => `${kind} ${percent(most[kind])}`);
  const t = longestMoment(run, jointAt(meta, "joint", most.joint));
  return [["Longest at a limit", place(run, "joint", most.joint, t), `${kinds.join(", ")} of the time`]];
}

function when({ recording: { meta } }: Run, { from, to, part, worst }: Check): Fact[] {
  return from === null ? [] : [["When", span(from, to ?? from), worst === null ? "" : partName(meta, part, worst)]];
}

function missing(first: Check, failed: Check[]): Fact[] {
  const text = failed.find((c) => c.missing)?.missing ?? "";
  // A text is `7.51 V at m8/passive (needs 14.9 V; 2.53 N m, 5.88 rad/s at most)`. The card omits the part after the
  // semicolon, which the table of checks contains.
  const [, amount, at, need] = /^(.*?)(?: at (\S+))?(?: \((.*?)[;)].*)?$/.exec(text)!;
  if (amount) return [["Missing", amount, [at ? `at ${at}` : "", need].filter(Boolean).join(", ")]];
  const strays = failed.find((c) => c.id === "tracking");
  if (!ofMotor(first) || !strays) return [];
  const { value, limit, unit } = strays;
  return [["Off its set point", quantity(value, unit), `limit ${quantity(limit, unit)}`]];
}

/** Facts of a run that is not infeasible: its tightest check, speed, cost of transport and period. */
export function walked(run: Run): Fact[] {
  const { meta } = run.recording;
  const { summary, cycle, ground } = meta;
  const facts = load(run);
  const walks = ground.kind !== "none";
  const fast = (summary.speed ?? 0) >= 1;
  if (walks && summary.speed) {
    facts.push(["Speed", number(summary.speed * (fast ? 1 : 100), 3, "m"), fast ? "m/s" : "cm/s"]);
  }
  const cost = summary.cost_of_transport?.electrical ?? null;
  if (walks && cost) facts.push(["Cost of transport", number(cost)]);
  if (cycle) facts.push(["Period", number(cycle.period, 4), "s"]);
  return facts;
}

/** The tightest check; without one the largest load of a motor; without motor limits the largest torque. */
function load(run: Run): Fact[] {
  const { checks, tightest: id } = run.recording.meta.verdict;
  const tightest = checks.find((c) => c.id === id);
  const most = hardest(run.recording.meta);
  if (tightest && tightest.margin !== null && tightest.limit) return [margin(run, tightest, tightest.margin)];
  if (most) {
    const share = `${percent(most.value!, 2)} of its motor at ${time(moment(run, most) ?? 0)}`;
    return [["Hardest worked", place(run, most.part, most.worst!, moment(run, most)), share]];
  }
  return run.loads.peak > 1e-6 ? [["Largest torque", number(run.loads.peak), "N m"]] : [];
}

/** Value of a check as a share of its limit, from its margin. */
export const shareOfLimit = ({ least }: Check, margin: number): string =>
  `${percent(least ? 1 + margin : 1 - margin, 2)} of the limit`;

function margin(run: Run, check: Check, left: number): Fact {
  const { part, title, worst: name } = check;
  const share = left >= 0 && left <= 1 ? shareOfLimit(check, left) : held(check);
  const word = left < 0 ? "Worst" : "Tightest";
  return name !== null && part !== "none"
    ? [word, place(run, part, name, moment(run, check)), `${inSentence(title)}: ${share}`]
    : [word, title, share];
}

export const built = (meta: Meta): Fact[] => [
  ["Modules", String(meta.modules.length)],
  ["Joints", String(meta.joints.length)],
  ["Mass", number(meta.mass), "kg"],
];
