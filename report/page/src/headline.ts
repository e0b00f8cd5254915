// The answer, before anything else: can the robot do it; if not, what was over a limit first, what is worst, when, how much is missing.
import { about } from "./about";
import { element, icon, make } from "./dom";
import type { Check, Meta, Overlay, Part } from "./format";
import { folder } from "./folder";
import { capital, fixed, number, percent, plural, quantity, sentence, span, time } from "./numbers";
import type { Desk, Run } from "./panel";
import { firstMoment, jointAt, longestMoment, moment, partName, show } from "./places";
import { signalLink } from "./strays";

type Mood = "good" | "bad" | "open" | "plan";
type Fact = [name: string, value: Node | string, small?: string];

const badges: Record<Mood, string> = {
  plan: "M12 6.6v.1M12 11v6.6",
  good: "M5 12.5l4.6 4.6L19 7.5", bad: "M6 6l12 12M18 6L6 18", open: "M8.6 9.2a3.5 3.5 0 1 1 5.2 3.1c-1.2.7-1.8 1.3-1.8 2.6M12 18.4v.1" };
const inSentence = (title: string): string => (/^[A-Z][a-z]/.test(title) ? title[0].toLowerCase() + title.slice(1) : title);

const few = 2; // checks that fail beside the first one, in the sentence: all stand in the table

interface Judgement {
  mood: Mood;
  said: string;
  why: string[];
  facts: Fact[];
}

export function headline(desk: Desk): void {
  const { ghost, recording: { meta } } = desk, own = element("verdict"), overlay = ghost?.overlay;
  if (!ghost || !overlay) {
    card(own, desk, judgement(desk, meta), aside(meta));
    return;
  }
  const both = element("pair"), list = both.querySelector("ul")!;
  both.hidden = false;
  if (overlay.strayed) {
    card(own, desk, strayed(desk, overlay, overlay.strayed), ["A golden keeps the torque, current and angle of every joint and the pose of the base, and this page shows no more."]);
  } else {
    const second = own.cloneNode(true) as HTMLElement;
    second.removeAttribute("id");
    second.setAttribute("aria-labelledby", "said-second");
    for (const one of second.querySelectorAll("[id]")) one.id = `${one.id}-second`;
    own.after(second);
    own.parentElement!.classList.add("two-runs");
    [own, second].forEach((host, n) => {
      const run = desk.runs[n], { meta: of } = run.recording, made = judgement(run, of);
      card(host, run, { ...made, facts: made.facts.slice(0, 4) }, aside(of, n === 0));
      host.querySelector(".words")!.prepend(make("p.whose", make(`span.tag-${n ? "second" : "own"}`, overlay.labels[n]), make("b", of.name), ` ${about(of)}`));
    });
  }
  const [a, b] = overlay.labels;
  both.querySelector("p")!.replaceChildren(make("span.k", `${a}: solid lines, and the robot in colours`), make("span.k.dash", `${b}: dashed lines, and the translucent robot`));
  const settings = make("details", make("summary", overlay.strayed ? "What is not as it was when the golden was approved" : `Where the settings of ${b} are not those of ${a}`), make("ul", ...overlay.differs.map((one) => make("li", one))));
  settings.open = overlay.differs.length <= 3;
  list.append(...ghost.apart.map((one) => make("li", one)), make("li", overlay.differs.length ? settings : overlay.strayed ? "Build, engine, step and scenario are those of the golden." : "Both runs have the same settings."));
}

function card(host: HTMLElement, run: Run, { mood, said, why, facts }: Judgement, beside: (string | Node)[]): void {
  const part = (name: string) => host.querySelector<HTMLElement>(`.${name}`)!, { missing, overlay } = run.recording.meta;
  host.dataset.mood = mood;
  part("badge").append(icon(badges[mood], 24));
  part("said").textContent = said;
  part("reason").textContent = why.join(" ");
  part("aside").append(...beside.flatMap((one) => [one, " "]));
  part("facts").dataset.count = String(facts.length);
  part("facts").append(...facts.map(([name, value, small]) => make("div", make("dt", name), make("dd", value, ...(small ? [" ", make("small", small)] : [])))));
  part("lacks").hidden = !missing.length || !!overlay?.strayed;
  part("lacks").append(...missing.map((m) => make("li", sentence(m))));
}

/** Of a run that strayed from its golden: what, where, when. */
function strayed(run: Run, { strays }: Overlay, text: string): Judgement {
  const worst = [...strays].sort((a, b) => b.ratio - a.ratio)[0], facts: Fact[] = [];
  if (strays[0] && strays[0].from !== null) facts.push(["First to leave its band", signalLink(run, strays[0]), `at ${fixed(strays[0].from, 2)} s`]);
  if (worst) facts.push(["Farthest off", signalLink(run, worst), `RMS ${number(worst.ratio)} bands`]);
  return { mood: "bad", said: "It strayed from its golden", why: [sentence(text)], facts };
}

function judgement(desk: Run, meta: Meta): Judgement {
  const { verdict, why, reason, rests_on } = meta.verdict, failed = failures(meta), facts = () => walked(desk, meta);
  if (meta.outcome === "not run") {
    return { mood: "plan", said: "Built, not run", why: ["The robot as the scenario describes it: its modules, the axes of its hinges, its faces. A verdict needs a run."], facts: built(meta) };
  }
  if (verdict === "failed") {
    return { mood: "bad", said: `The run ended early, at ${quantity(meta.duration, "s")}`, why: [sentence(why || meta.outcome), ...others(failed.filter((c) => c.id !== "outcome"))], facts: facts() };
  }
  if (verdict === "infeasible") {
    const [first, ...rest] = failed;
    return { mood: "bad", said: first?.group === "motor" ? "Not feasible with these motors" : "Not feasible", why: [sentence(why), ...others(rest)], facts: first ? shortfall(desk, first, failed) : facts() };
  }
  if (verdict === "not judged") return { mood: "open", said: "Not judged", why: [sentence(why || reason), ...(reason.includes("so far:") ? [] : others(failed))], facts: facts() };
  const most = hardest(meta), left = most && most.value! < 1 ? [`The motors have at least ${percent(1 - most.value!, 2)} of their torque left, at the speeds that they reach.`] : [];
  const kept = meta.verdict.checks.some((c) => c.group !== "trust" && c.status === "warn") ? "no check fails" : "every limit that is known is kept";
  return { mood: "good", said: "Feasible with these motors", why: [sentence(rests_on ? `over ${rests_on}: ${kept}` : kept), ...left], facts: facts() };
}

/** What fails: first what the word rests on, then what concerns the robot as a whole, then from the least margin on. */
function failures({ verdict: { checks, decided_by } }: Meta): Check[] {
  const urgency = ({ id, group, margin }: Check) => (id === decided_by ? [0, 0] : [group === "run" ? 1 : 2, margin ?? -1e300]);
  const sooner = ([a, m]: number[], [b, n]: number[]) => a - b || m - n;
  return checks.filter((c) => c.status === "fail").sort((a, b) => sooner(urgency(a), urgency(b)));
}

/** The check that the page opens at: what the word rests on, what is too close, else the tightest one; null: none leads anywhere. */
export function leading(run: Run): Check | null {
  const { meta } = run.recording, { checks, tightest, verdict } = meta.verdict;
  const placed = (c: Check | undefined) => (c && (moment(run, c) !== null || jointAt(meta, c.part, c.worst) >= 0) ? c : null);
  return failures(meta)[0] ?? placed(checks.find((c) => c.status === "too close")) ?? (verdict === "feasible" ? placed(checks.find((c) => c.id === tightest)) : null) ?? hardest(meta);
}

function others(failed: Check[]): string[] {
  const rest = failed.length - few;
  return failed.length ? [`Also: ${briefly(failed.slice(0, few))}${rest > 0 ? `; ${plural(rest, "more check")} fail${rest > 1 ? "" : "s"}` : ""}.`] : [];
}

/** What the checks found, without advice. */
const briefly = (found: Check[]): string => found.map((c) => c.text.split("; ")[0].replace(/[.]$/, "")).join("; ");

// What limits the answer: warnings, what makes the numbers doubtful, what nobody judged.
function aside(meta: Meta, own = true): (string | Node)[] {
  if (meta.outcome === "not run") return [];
  const { verdict, counts, chosen_motors, chosen_docks, demand } = meta.verdict;
  const of = (trust: boolean, ...status: Check["status"][]) => meta.verdict.checks.filter((c) => status.includes(c.status) && (c.group === "trust") === trust);
  const warned = of(false, "warn"), doubtful = of(true, "warn"), open = of(false, "not judged"), gait = of(false, "fail"), limited = gait.some((c) => c.id === "voltage" || c.id === "current");
  return [
    ...(warned.length ? [verdict === "feasible" ? `Warned of: ${briefly(warned)}.` : `${capital(plural(counts.warn, "warning"))}.`] : []),
    ...(chosen_motors ? ["Figures of the motors are chosen, not a maker's."] : []), ...(chosen_docks ? ["Figures of what docks hold are chosen."] : []),
    ...(limited && !gait.some((c) => c.missing) ? ["How much is missing was not computed. To compute it:", make("code", make("span.whole", "gaitlab report --demand"), ` ${own ? folder() : "FOLDER"}`)] : []),
    ...(doubtful.length ? [`Doubtful: ${briefly(doubtful)}.`] : []),
    ...(demand?.doubt ? [sentence(demand.doubt)] : []),
    ...(open.length > 6 ? [`${open.length} checks were not judged.`] : open.length ? [`Not judged: ${open.map((c) => inSentence(c.title)).join(", ")}.`] : []),
  ];
}

/** The check on the torque that a motor gives, of what it has at that speed, where it was judged. */
const hardest = (meta: Meta): Check | null =>
  meta.verdict.checks.find((c) => c.id === "envelope" && c.status !== "not judged" && c.value !== null && c.worst !== null) ?? null;

const held = ({ value, limit, unit, least }: Check): string => `${quantity(value, unit)}, limit ${least ? "≥ " : ""}${quantity(limit, unit)}`;

// Worst, first, longest: as the terminal and the figure have them. Worst: what is farthest beyond its limit. First: what was beyond it
// before the others. Longest: the joint that is at any limit of its motor for most of the judged time.
function shortfall(run: Run, first: Check, failed: Check[]): Fact[] {
  const { meta } = run.recording, { longest } = meta.verdict, atLimit = first.id === "voltage" || first.id === "current";
  const facts: Fact[] = [], missing = failed.find((c) => c.missing)?.missing;
  if (first.first !== null && first.first_part !== null) facts.push(["First over the limit", place(run, first.part, first.first_part, firstMoment(run, first)), `at ${time(first.first)}`]);
  if (first.worst !== null) facts.push(["Worst", place(run, first.part, first.worst, moment(run, first)), held(first)]);
  else if (first.value !== null) facts.push(["Worst", quantity(first.value, first.unit), `limit ${first.least ? "≥ " : ""}${quantity(first.limit, first.unit)}`]);
  if (atLimit && longest) {
    const kinds = ([["voltage", longest.voltage], ["current", longest.current]] as const).filter(([, share]) => share > 0).map(([kind, share]) => `${kind} ${percent(share)}`);
    facts.push(["Longest at a limit", place(run, "joint", longest.joint, longestMoment(run, jointAt(meta, "joint", longest.joint))), `${kinds.join(", ")} of the time`]);
  }
  if (first.from !== null) facts.push(["When", span(first.from, first.to ?? first.from), first.worst === null ? "" : partName(meta, first.part, first.worst)]);
  const strays = failed.find((c) => c.id === "tracking");
  // `7.51 V at m8/passive (needs 14.9 V; 2.53 N m, 5.88 rad/s at most)`: the rest stands in the row of the check.
  const [, amount, at, need] = /^(.*?)(?: at (\S+))?(?: \((.*?)[;)].*)?$/.exec(missing ?? "")!;
  if (amount) facts.push(["Missing", amount, [at ? `at ${at}` : "", need].filter(Boolean).join(", ")]);
  else if (atLimit && strays) facts.push(["Off its set point", quantity(strays.value, strays.unit), `limit ${quantity(strays.limit, strays.unit)}`]);
  return facts;
}

function place(run: Run, part: Part, name: string, t: number | null): HTMLButtonElement {
  const go = make("button.link", partName(run.recording.meta, part, name));
  go.type = "button";
  go.addEventListener("click", () => show(run, part, name, t));
  return go;
}

function walked(desk: Run, meta: Meta): Fact[] {
  const { summary, cycle } = meta, facts: Fact[] = [], tightest = meta.verdict.checks.find((c) => c.id === meta.verdict.tightest), most = hardest(meta);
  if (tightest && tightest.margin !== null && tightest.limit) {
    const { margin, least } = tightest, named = tightest.worst !== null && tightest.part !== "none", share = margin >= 0 && margin <= 1 ? `${percent(least ? 1 + margin : 1 - margin, 2)} of the limit` : held(tightest);
    facts.push([margin < 0 ? "Worst" : "Tightest", named ? place(desk, tightest.part, tightest.worst!, moment(desk, tightest)) : tightest.title, named ? `${inSentence(tightest.title)}: ${share}` : share]);
  } else if (most) facts.push(["Hardest worked", place(desk, most.part, most.worst!, moment(desk, most)), `${percent(most.value!, 2)} of its motor at ${time(moment(desk, most) ?? 0)}`]);
  else if (desk.loads.peak > 1e-6) facts.push(["Largest torque", number(desk.loads.peak), "N m"]);
  const walks = meta.ground.kind !== "none";
  if (walks && summary.speed) facts.push(["Speed", number(100 * summary.speed, 3, "m"), "cm/s"]);
  const cost = summary.cost_of_transport?.electrical ?? null;
  if (walks && cost) facts.push(["Cost of transport", number(cost)]);
  if (cycle) facts.push(["Period", number(cycle.period, 4), "s"]);
  return facts;
}

const built = (meta: Meta): Fact[] => [["Modules", String(meta.modules.length)], ["Joints", String(meta.joints.length)], ["Mass", number(meta.mass), "kg"]];
