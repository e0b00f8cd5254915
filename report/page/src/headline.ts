// The answer, before anything else: can the robot do it; if not, which joint first, when, how much is missing.
import { element, icon, make } from "./dom";
import type { Check, Meta } from "./format";
import { fixed, number, percent, plural, quantity, span } from "./numbers";
import type { Desk } from "./panel";

type Mood = "good" | "bad" | "open";
type Fact = [name: string, value: Node | string, small?: string];

const badges: Record<Mood, string> = { good: "M5 12.5l4.6 4.6L19 7.5", bad: "M6 6l12 12M18 6L6 18", open: "M8.6 9.2a3.5 3.5 0 1 1 5.2 3.1c-1.2.7-1.8 1.3-1.8 2.6M12 18.4v.1" };
const inSentence = (title: string): string => (/^[A-Z][a-z]/.test(title) ? title[0].toLowerCase() + title.slice(1) : title);
const ended = (text: string): string => (/[.!?]$/.test(text) ? text : `${text}.`);
const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

export function headline(desk: Desk): void {
  const { meta } = desk.recording, { mood, said, why, facts } = judgement(desk, meta);
  element("verdict").dataset.mood = mood;
  element("badge").append(icon(badges[mood], 24));
  element("said").textContent = said;
  element("why").replaceChildren(...why.flatMap((s, i) => (i ? [" ", s] : [s])));
  element("facts").append(...facts.map(([name, value, small]) => make("div", make("dt", name), make("dd", value, ...(small ? [make("small", ` ${small}`)] : [])))));
  const notes = element("missing");
  notes.hidden = !meta.missing.length;
  notes.append(...meta.missing.map((m) => make("li", ended(m))));
}

function judgement(desk: Desk, meta: Meta): { mood: Mood; said: string; why: (Node | string)[]; facts: Fact[] } {
  const { checks, verdict } = meta.verdict;
  const gait = checks.filter((c) => c.group !== "trust"), failed = gait.filter((c) => c.status === "fail");
  if (meta.outcome === "not run") {
    return { mood: "open", said: "Built, not run", why: ["The robot as the scenario describes it, before a run: its modules, hinge axes and faces. There is no verdict without a run."], facts: built(meta) };
  }
  if (verdict === "failed") {
    return { mood: "bad", said: `The run ended early, at ${fixed(meta.duration, 2)} s`, why: [ended(capital(meta.outcome)), ...others(failed.filter((c) => c.id !== "outcome")), ...doubts(checks)], facts: walked(desk, meta) };
  }
  if (verdict === "infeasible") {
    const [first, ...rest] = failed;
    return {
      mood: "bad", said: "Not feasible with these motors",
      why: first ? [ended(capital(first.text)), ...(first.source.includes("chosen") ? ["(The limit is chosen.)"] : []), ...others(rest), ...doubts(checks)] : [],
      facts: first ? shortfall(desk, first, failed) : walked(desk, meta),
    };
  }
  if (verdict === "not judged") {
    return { mood: "open", said: "Not judged", why: ["Nothing is known of what the motors can do, so nobody can say whether they can do this.", ...others(failed), ...doubts(checks)], facts: walked(desk, meta) };
  }
  const near = nearest(gait), why = near ? [`Every limit that is known is kept. Nearest to its limit: ${inSentence(near.title)}, ${quantity(near.value, near.unit)} of ${quantity(near.limit, near.unit)}${near.joint ? ` (${near.joint})` : ""}.`] : [];
  return { mood: "good", said: meta.motors.length ? "Feasible with these motors" : "Feasible", why: [...why, ...doubts(checks)], facts: walked(desk, meta) };
}

function others(failed: Check[]): string[] {
  return failed.length ? [`Over the limit, too: ${failed.map((c) => `${inSentence(c.title)} (${quantity(c.value, c.unit)})`).join(", ")}.`] : [];
}

// What limits the answer: warnings, what makes the numbers doubtful, what nobody judged.
function doubts(checks: Check[]): string[] {
  const of = (status: Check["status"], trust: boolean) => checks.filter((c) => c.status === status && (c.group === "trust") === trust);
  const list = (found: Check[]) => found.map((c) => `${inSentence(c.title)} (${quantity(c.value, c.unit)})`).join(", ");
  const warned = of("warn", false), doubtful = [...of("fail", true), ...of("warn", true)], open = of("not judged", false);
  return [
    ...(warned.length ? [`Close to a limit: ${list(warned)}.`] : []),
    ...(doubtful.length ? [`Reason to doubt the numbers: ${list(doubtful)}.`] : []),
    ...(open.length ? [`Not judged, for want of a limit: ${open.map((c) => inSentence(c.title)).join(", ")}.`] : []),
  ];
}

/** The check that is nearest to its limit, of those where more is worse. */
function nearest(checks: Check[]): Check | null {
  const share = (c: Check) => c.value! / c.limit!;
  const known = checks.filter((c) => !["outcome", "fall", "stability"].includes(c.id) && c.status !== "not judged" && c.value !== null && c.limit !== null && c.limit > 0);
  return known.sort((a, b) => share(b) - share(a))[0] ?? null;
}

function shortfall(desk: Desk, first: Check, failed: Check[]): Fact[] {
  const { meta } = desk.recording, early = first.group === "motor" ? firstAtLimit(desk) : null, missing = failed.find((c) => c.missing);
  const facts: Fact[] = [];
  if (early) facts.push(["First at its limit", place(desk, meta.joints[early.joint].name, early.t), `at ${fixed(early.t, 2)} s`]);
  if (first.joint) facts.push([early ? "Worst joint" : "Joint", place(desk, first.joint, first.from), first.joints > 1 ? `of ${plural(first.joints, "joint")}` : ""]);
  if (first.from !== null) facts.push(["When", span(first.from, first.to ?? first.from)]);
  facts.push(missing ? ["Missing", missing.missing] : first.limit !== null && first.id !== "voltage" && first.id !== "current" ? ["Found, limit", quantity(first.value, first.unit), `of ${quantity(first.limit, first.unit)}`]
    : ["At its limit", quantity(first.value, first.unit), "of the time"]);
  return facts;
}

/** The joint that is the first in the judged window whose motor gives all it can. */
export function firstAtLimit(desk: Desk): { joint: number; t: number } | null {
  const { recording } = desk, from = recording.judged;
  let row = Infinity, joint = -1;
  recording.meta.joints.forEach((_, j) => {
    const flags = recording.find(`joint.${j}.saturation`);
    for (let i = from; flags && i < Math.min(flags.length, row); i++) if (flags[i] > 0) { row = i; joint = j; }
  });
  return joint < 0 ? null : { joint, t: recording.times[row] };
}

function place(desk: Desk, name: string, t: number | null): HTMLButtonElement {
  const go = make("button.link", name);
  go.type = "button";
  go.addEventListener("click", () => {
    desk.choose(desk.recording.meta.joints.findIndex((j) => j.name === name));
    if (t !== null) desk.goTo(t);
  });
  return go;
}

function walked(desk: Desk, meta: Meta): Fact[] {
  const { summary, cycle } = meta, facts: Fact[] = [], { peaks } = desk.loads;
  if (desk.loads.limited) {
    const from = desk.recording.judged, most = meta.joints.map((_, j) => desk.loads.share(j).reduce((a, x, i) => (i >= from && x > a ? x : a), 0)), j = most.indexOf(Math.max(...most));
    facts.push(["Hardest worked", place(desk, meta.joints[j].name, null), percent(most[j], 2)]);
  } else if (peaks.length) facts.push(["Largest torque", number(Math.max(...peaks)), "N m"]);
  if (summary.speed) facts.push(["Speed", number(100 * summary.speed), "cm/s"]);
  const cost = summary.cost_of_transport?.electrical ?? null;
  if (cost !== null) facts.push(["Cost of transport", number(cost)]);
  if (cycle) facts.push(["Period", number(cycle.period, 4), "s"]);
  return facts;
}

const built = (meta: Meta): Fact[] => [["Modules", String(meta.modules.length)], ["Joints", String(meta.joints.length)], ["Mass", number(meta.mass), "kg"]];
