// Judgement of a run in words: the verdict, the reasons for the verdict, and the limitations of the verdict.
import { make } from "../dom";
import { happened } from "./events";
import { built, hardest, shortfall, walked, type Fact } from "./facts";
import { folder, word } from "../data/folder";
import type { Check, Meta } from "../data/format";
import { capital, inSentence, percent, plural, quantity, sentence, sentences } from "../data/numbers";
import type { Run } from "../panel";
import { jointAt, moment } from "../data/places";

export type Mood = "good" | "bad" | "open" | "plan";

export interface Judgement {
  mood: Mood;
  said: string;
  why: (string | Node)[];
  facts: Fact[];
}

const few = 2; // largest number of further failed checks in the sentence; the table of checks contains all

/** Command to copy. A line does not break within its `start`. */
const command = (start: string, ...words: string[]): HTMLElement =>
  make("code", make("span.whole", start), ...words.map((one) => ` ${one}`));

/** Judgement of a run in a folder. */
export function judgement(run: Run, place = folder(run.recording.meta)): Judgement {
  const { draws, unstable } = run.recording.meta.verdict ?? {};
  // All other findings follow from an unstable controller, and are therefore left out.
  const found = ofRun(run, place);
  const judged = unstable ? { ...found, why: [sentence(unstable)], facts: [] } : found;
  if (!draws) return judged;
  const why = [...judged.why, sentence(draws.text)];
  if (judged.mood !== "good" || draws.feasible === draws.count) return { ...judged, why };
  return { ...judged, mood: "open", said: `Feasible with ${draws.feasible} of ${draws.count} seeds`, why };
}

function ofRun(run: Run, place: string): Judgement {
  const { outcome, verdict } = run.recording.meta;
  if (outcome === "not run") return planned(run);
  switch (verdict.verdict) {
    case "failed":
      return ended(run);
    case "infeasible":
      return infeasible(run);
    case "not judged":
      return unjudged(run, place);
    case "feasible":
      return feasible(run);
  }
}

const planned = ({ recording: { meta } }: Run): Judgement => ({
  mood: "plan",
  said: "Built, not run",
  why: [
    "The robot as the scenario describes it: its modules, the axes of its hinges, its faces. A verdict needs a run.",
  ],
  facts: built(meta),
});

function ended(run: Run): Judgement {
  const { meta } = run.recording;
  return {
    mood: "bad",
    said: `The run ended early, at ${quantity(meta.duration, "s")}`,
    why: [sentence(meta.verdict.why || meta.outcome), ...others(meta, failures(meta))],
    facts: walked(run),
  };
}

function infeasible(run: Run): Judgement {
  const { meta } = run.recording;
  const failed = failures(meta);
  const [first, ...rest] = failed;
  return {
    mood: "bad",
    said: first?.group === "motor" && !meta.verdict.unstable ? "Not feasible with these motors" : "Not feasible",
    why: [sentence(meta.verdict.why), ...others(meta, rest)],
    facts: first ? shortfall(run, first, failed) : walked(run),
  };
}

/** Judgement that begins with the missing evidence, and the command that supplies it if one is known. */
function unjudged(run: Run, place: string): Judgement {
  const { meta } = run.recording;
  const { why, reason, reason_check, reason_code, retry = [], checks } = meta.verdict;
  const [lacks, found] = (why || reason).split("; so far: ");
  const close = checks.find((c) => reason_code === "too close" && c.id === reason_check);
  const sets = retry.flatMap((one) => ["--set", word(one)]);
  const again = retry.length
    ? command("gaitlab run", `${place}/scenario.resolved.yaml`, ...sets)
    : reason_code === "rows alone" && command("gaitlab rerun", place);
  // The command replaces its advice.
  const told = sentences(lacks).filter((one) => !again || !/^(Take|Gaitlab) /.test(one));
  const failed = failures(meta);
  return {
    mood: "open",
    said: "Not judged",
    why: [
      ...(close ? [`The value of the check “${close.title}” is too close to its limit.`] : []),
      ...told.slice(0, close ? 0 : 1),
      ...(again ? [make("span.by", "Judge by ", again)] : []),
      ...told.slice(close ? 0 : 1),
      ...(found ? [`So far: ${sentence(found)}`] : []),
      ...(failed.some((c) => c.id === reason_check) ? [] : others(meta, failed)),
    ],
    facts: walked(run),
  };
}

function feasible(run: Run): Judgement {
  const { meta } = run.recording;
  const { checks, rests_on } = meta.verdict;
  const most = hardest(meta);
  const left =
    most && most.value! < 1
      ? [`The motors have at least ${percent(1 - most.value!, 2)} of their torque left, at the speeds that they reach.`]
      : [];
  const kept = checks.some((c) => c.group !== "trust" && c.status === "warn")
    ? "no check fails"
    : "all known limits are kept";
  return {
    mood: "good",
    said: "Feasible with these motors",
    why: [sentence(rests_on ? `over ${rests_on}: ${kept}` : kept), ...left],
    facts: walked(run),
  };
}

/** Failed checks in the order of the program. */
export function failures({ verdict: { checks, failures } }: Meta): Check[] {
  return failures.flatMap((id) => checks.find((c) => c.id === id) ?? []);
}

/**
 * The check that the page shows first. It is the first of these that exists: the failed check that decides the verdict,
 * a check that is too close, the tightest check of a feasible run, the check `envelope`. Null if none exists.
 */
export function leading(run: Run): Check | null {
  const { meta } = run.recording;
  const { checks, tightest, verdict } = meta.verdict;
  const placed = (c: Check | undefined) =>
    c && (moment(run, c) !== null || jointAt(meta, c.part, c.worst) >= 0) ? c : null;
  return (
    failures(meta)[0] ??
    placed(checks.find((c) => c.status === "too close")) ??
    (verdict === "feasible" ? placed(checks.find((c) => c.id === tightest)) : null) ??
    hardest(meta)
  );
}

/** Failed checks that the line of events does not contain. */
function others(meta: Meta, all: Check[]): string[] {
  const failed = all.filter((c) => c.id !== "outcome" && !happened(meta).includes(c));
  const rest = failed.length - few;
  const more = rest > 0 ? `; ${plural(rest, "more check")} fail${rest > 1 ? "" : "s"}` : "";
  return failed.length ? [`Also: ${briefly(failed.slice(0, few))}${more}.`] : [];
}

/** Findings of the checks, without advice. */
const briefly = (found: Check[]): string => found.map((c) => c.text.split("; ")[0].replace(/[.]$/, "")).join("; ");

/** Limitations of the verdict: warnings, doubtful numbers, checks that were not judged. None for an unstable run. */
export function aside(meta: Meta, place = folder(meta)): (string | Node)[] {
  if (meta.outcome === "not run" || meta.verdict.unstable) return [];
  const { verdict, counts, chosen_motors, chosen_docks, demand } = meta.verdict;
  const of = (trust: boolean, ...status: Check["status"][]) =>
    meta.verdict.checks.filter((c) => status.includes(c.status) && (c.group === "trust") === trust);
  const warned = of(false, "warn");
  const doubtful = of(true, "warn");
  const open = meta.verdict.checks.filter((c) => c.status === "not judged"); // the checks that the list folds
  const gait = of(false, "fail");
  const limited = gait.some((c) => c.id === "voltage" || c.id === "current");
  return [
    ...(warned.length
      ? [verdict === "feasible" ? `Warned of: ${briefly(warned)}.` : `${capital(plural(counts.warn, "warning"))}.`]
      : []),
    ...(chosen_motors ? ["Motor data are chosen, not the manufacturer's."] : []),
    ...(chosen_docks ? ["Strengths of the docks are chosen."] : []),
    ...(limited && !gait.some((c) => c.missing)
      ? ["The missing torque or current was not computed. To compute it:", command("gaitlab report --demand", place)]
      : []),
    ...(doubtful.length ? [`Doubtful: ${briefly(doubtful)}.`] : []),
    ...(demand?.doubt ? [sentence(demand.doubt)] : []),
    ...(open.length > 6
      ? [`${open.length} checks were not judged.`]
      : open.length
        ? [`Not judged: ${open.map((c) => inSentence(c.title)).join(", ")}.`]
        : []),
  ];
}
