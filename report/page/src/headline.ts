// The answer, before anything else: can the robot do it; if not, which joint first, when, how much is missing.
import { about } from "./about";
import { element, icon, make } from "./dom";
import type { Check, Meta, Overlay } from "./format";
import { fixed, number, percent, plural, quantity, span } from "./numbers";
import type { Desk, Run } from "./panel";
import { signalLink } from "./strays";

type Mood = "good" | "bad" | "open" | "plan";
type Fact = [name: string, value: Node | string, small?: string];

const badges: Record<Mood, string> = {
  plan: "M12 6.6v.1M12 11v6.6",
  good: "M5 12.5l4.6 4.6L19 7.5", bad: "M6 6l12 12M18 6L6 18", open: "M8.6 9.2a3.5 3.5 0 1 1 5.2 3.1c-1.2.7-1.8 1.3-1.8 2.6M12 18.4v.1" };
const inSentence = (title: string): string => (/^[A-Z][a-z]/.test(title) ? title[0].toLowerCase() + title.slice(1) : title);
const ended = (text: string): string => (/[.!?]$/.test(text) ? text : `${text}.`);
const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

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
      card(host, run, { ...made, facts: made.facts.slice(0, 4) }, aside(of));
      host.querySelector(".words")!.prepend(make("p.whose", make(`span.tag-${n ? "second" : "own"}`, overlay.labels[n]), make("b", of.name), ` ${about(of)}`));
    });
  }
  const [a, b] = overlay.labels;
  both.querySelector("p")!.replaceChildren(make("span.k", `${a}: solid lines, and the robot in colours`), make("span.k.dash", `${b}: dashed lines, and the translucent robot`));
  const settings = make("details", make("summary", overlay.strayed ? "What is not as it was when the golden was approved" : `Where the settings of ${b} are not those of ${a}`), make("ul", ...overlay.differs.map((one) => make("li", one))));
  settings.open = overlay.differs.length <= 3;
  list.append(...ghost.apart.map((one) => make("li", one)), make("li", overlay.differs.length ? settings : overlay.strayed ? "Build, engine, step and scenario are those of the golden." : "Both runs have the same settings."));
}

function card(host: HTMLElement, run: Run, { mood, said, why, facts }: Judgement, beside: string[]): void {
  const part = (name: string) => host.querySelector<HTMLElement>(`.${name}`)!, { missing, overlay } = run.recording.meta;
  host.dataset.mood = mood;
  part("badge").append(icon(badges[mood], 24));
  part("said").textContent = said;
  part("reason").textContent = why.join(" ");
  part("aside").textContent = beside.join(" ");
  part("facts").dataset.count = String(facts.length);
  part("facts").append(...facts.map(([name, value, small]) => make("div", make("dt", name), make("dd", value, ...(small ? [" ", make("small", small)] : [])))));
  part("lacks").hidden = !missing.length || !!overlay?.strayed;
  part("lacks").append(...missing.map((m) => make("li", ended(m))));
}

/** Of a run that strayed from its golden: what, where, when. */
function strayed(run: Run, { strays }: Overlay, text: string): Judgement {
  const worst = [...strays].sort((a, b) => b.ratio - a.ratio)[0], facts: Fact[] = [];
  if (strays[0] && strays[0].from !== null) facts.push(["First to leave its band", signalLink(run, strays[0]), `at ${fixed(strays[0].from, 2)} s`]);
  if (worst) facts.push(["Farthest off", signalLink(run, worst), `RMS ${number(worst.ratio)} bands`]);
  return { mood: "bad", said: "It strayed from its golden", why: [ended(capital(text))], facts };
}

function judgement(desk: Run, meta: Meta): Judgement {
  const { checks, verdict } = meta.verdict;
  const gait = checks.filter((c) => c.group !== "trust"), failed = gait.filter((c) => c.status === "fail");
  if (meta.outcome === "not run") {
    return { mood: "plan", said: "Built, not run", why: ["The robot as the scenario describes it: its modules, the axes of its hinges, its faces. A verdict needs a run."], facts: built(meta) };
  }
  if (verdict === "failed") {
    return { mood: "bad", said: `The run ended early, at ${quantity(meta.duration, "s")}`, why: [ended(capital(meta.outcome)), ...others(failed.filter((c) => c.id !== "outcome"))], facts: walked(desk, meta) };
  }
  if (verdict === "infeasible") {
    const [first, ...rest] = failed;
    return {
      mood: "bad", said: first?.group === "motor" ? "Not feasible with these motors" : "Not feasible",
      why: first ? [ended(capital(first.text)), ...others(rest)] : [],
      facts: first ? shortfall(desk, first, failed) : walked(desk, meta),
    };
  }
  if (verdict === "not judged") {
    const cause = meta.motors.length ? "Nothing is known of what the motors can do, so nobody can say whether they can do this." : "There are no motors whose limits this run could exceed.";
    return { mood: "open", said: "Not judged", why: [cause, ...others(failed)], facts: walked(desk, meta) };
  }
  const most = hardest(meta), left = most && most.value! < 1 ? ` The motors have at least ${percent(1 - most.value!, 2)} of their torque left, at the speeds that they reach.` : "";
  const why = [`${gait.some((c) => c.status === "warn") ? "No limit is exceeded so far that the gait fails." : "Every limit that is known is kept."}${left}`];
  return { mood: "good", said: meta.motors.length ? "Feasible with these motors" : "Feasible", why, facts: walked(desk, meta) };
}

function others(failed: Check[]): string[] {
  return failed.length ? [`Also: ${briefly(failed)}.`] : [];
}

/** What the checks found, without advice. */
const briefly = (found: Check[]): string => found.map((c) => c.text.split("; ")[0].replace(/[.]$/, "")).join("; ");

// What limits the answer: warnings, what makes the numbers doubtful, what nobody judged.
function aside(meta: Meta): string[] {
  if (meta.outcome === "not run") return [];
  const of = (trust: boolean, ...status: Check["status"][]) => meta.verdict.checks.filter((c) => status.includes(c.status) && (c.group === "trust") === trust);
  const warned = of(false, "warn"), doubtful = of(true, "warn", "fail"), open = of(false, "not judged"), bad = meta.verdict.verdict !== "feasible", gait = of(false, "fail"), limited = gait.some((c) => c.id === "voltage" || c.id === "current");
  return [
    ...(warned.length ? [bad ? `${capital(plural(meta.verdict.counts.warn, "warning"))}.` : `Warned of: ${briefly(warned)}.`] : []),
    ...(meta.verdict.chosen_motors ? ["Figures of the motors are chosen, not a maker's."] : []),
    ...(limited && !gait.some((c) => c.missing) ? [`How much is missing was not asked; gaitlab report --demand tells.`] : []),
    ...(doubtful.length ? [`Doubtful: ${briefly(doubtful)}.`] : []),
    ...(meta.verdict.demand?.doubt ? [ended(capital(meta.verdict.demand.doubt))] : []),
    ...(open.length > 6 ? [`${open.length} checks were not judged, because nobody states a limit.`] : open.length ? [`Not judged, because nobody states a limit: ${open.map((c) => inSentence(c.title)).join(", ")}.`] : []),
  ];
}

/** The check on the torque that a motor gives, of what it has at that speed, where it was judged. */
export const hardest = (meta: Meta): Check | null =>
  meta.verdict.checks.find((c) => c.id === "envelope" && c.status !== "not judged" && c.value !== null && c.joint !== null) ?? null;

function shortfall(desk: Run, first: Check, failed: Check[]): Fact[] {
  const { meta } = desk.recording, motor = first.id === "voltage" || first.id === "current", early = motor ? firstAtLimit(desk) : null;
  const facts: Fact[] = [], missing = failed.find((c) => c.missing)?.missing;
  if (early) facts.push(["First of the run at a limit", place(desk, meta.joints[early.joint].name, early.t), `at ${fixed(early.t, 2)} s`]);
  if (first.joint) facts.push([motor ? "Longest at its limit" : "Joint", place(desk, first.joint, first.from), motor ? `${quantity(first.value, first.unit)} of the time` : ""]);
  if (first.from !== null) facts.push([motor ? "Its longest stretch" : "When", span(first.from, first.to ?? first.from)]);
  const strays = failed.find((c) => c.id === "tracking");
  // `7.51 V (needs 14.9 V; 2.53 N m, 5.88 rad/s at most)`: the rest stands in the row of the check.
  const [amount, need] = /^(.*?)(?: \((.*?)[;)].*)?$/.exec(missing ?? "")!.slice(1);
  if (amount) facts.push(["Missing", amount, need]);
  else if (motor && strays) facts.push(["Off its set point", quantity(strays.value, strays.unit), `limit ${quantity(strays.limit, strays.unit)}`]);
  else if (motor) facts.push(["Missing", "not measured"]);
  else if (first.value !== null && first.limit !== null) facts.push(["Found", quantity(first.value, first.unit), `limit ${quantity(first.limit, first.unit)}`]);
  return facts;
}

/** The joint that is the first of the run at a limit of its motor, however shortly. */
export function firstAtLimit(desk: Run): { joint: number; t: number } | null {
  const { joints, verdict: { first } } = desk.recording.meta, joint = first ? joints.findIndex((j) => j.name === first.joint) : -1;
  return first && joint >= 0 ? { joint, t: first.time } : null;
}

function place(desk: Run, name: string, t: number | null): HTMLButtonElement {
  const go = make("button.link", name);
  go.type = "button";
  go.addEventListener("click", () => {
    desk.choose(desk.recording.meta.joints.findIndex((j) => j.name === name));
    if (t !== null) desk.goTo(t);
  });
  return go;
}

function walked(desk: Run, meta: Meta): Fact[] {
  const { summary, cycle } = meta, facts: Fact[] = [];
  const most = hardest(meta);
  if (most) {
    facts.push(["Hardest worked", place(desk, most.joint!, most.from), `${percent(most.value!, 2)} of its motor at ${fixed(most.from ?? 0, 2)} s`]);
  } else if (desk.loads.limited) {
    const { joint, share, t } = desk.loads.hardest;
    facts.push(["Hardest worked", place(desk, meta.joints[joint].name, t), `${percent(share, 2)} of its motor`]);
  } else if (desk.loads.peak > 1e-6) facts.push(["Largest torque", number(desk.loads.peak), "N m"]);
  const walks = meta.ground.kind !== "none";
  if (walks && summary.speed) facts.push(["Speed", number(100 * summary.speed), "cm/s"]);
  const cost = summary.cost_of_transport?.electrical ?? null;
  if (walks && cost) facts.push(["Cost of transport", number(cost)]);
  if (cycle) facts.push(["Period", number(cycle.period, 4), "s"]);
  return facts;
}

const built = (meta: Meta): Fact[] => [["Modules", String(meta.modules.length)], ["Joints", String(meta.joints.length)], ["Mass", number(meta.mass), "kg"]];
