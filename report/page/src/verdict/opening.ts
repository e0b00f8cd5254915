// First view of the page: the joint, time and check that the page shows when a browser opens it.
import type { Check } from "../data/format";
import { leading } from "./judgement";
import type { Desk, Run } from "../panel";
import { jointAt, moment } from "../data/places";
import { jointOf } from "../plots/strays";

type Source = Pick<Desk, "recording" | "loads" | "ghost" | "runs">;

export interface Opening {
  run: Run; // the first run that is infeasible or failed, or the first run if there is no such run
  check: Check | null;
  joint: number; // number of the joint; -1 if the robot has no joints
  t: number;
}

export function opening(source: Source, link: URLSearchParams): Opening {
  const { recording, runs } = source;
  const { meta } = recording;
  const fails = (one: Run) => ["infeasible", "failed"].includes(one.recording.meta.verdict.verdict);
  const run = runs.find(fails) ?? runs[0];
  const check = meta.outcome === "not run" ? null : leading(run);
  const t = link.has("t") ? Number(link.get("t")) : firstTime(source, run, check);
  return {
    run,
    check,
    joint: meta.joints.length ? firstJoint(source, run, check, link.get("joint")) : -1,
    t: Number.isFinite(t) ? t : 0,
  };
}

/** Joint of the link, the first stray signal, the check, or the largest load: the first of these that exists. */
function firstJoint({ recording, loads, ghost }: Source, run: Run, check: Check | null, linked: string | null): number {
  const stray = ghost?.overlay.strays[0];
  const theirs = check ? jointAt(run.recording.meta, check.part, check.worst) : -1;
  const found = [
    recording.meta.joints.findIndex((j) => j.name === linked),
    stray ? jointOf(stray) : -1,
    run.recording === recording ? theirs : ghost!.jointBack(theirs),
  ];
  return found.find((j) => j >= 0) ?? loads.hardest.joint;
}

/** Time of the first stray signal, the check, or the largest load, s: the first of these that exists. */
function firstTime({ recording, loads, ghost }: Source, run: Run, check: Check | null): number {
  const { joints, verdict } = recording.meta;
  const seen = check && moment(run, check);
  const found =
    ghost?.overlay.strays[0]?.from ?? (run.recording !== recording && seen !== null ? ghost!.back(seen) : seen);
  if (found !== null) return found;
  if (!recording.ran) return 0;
  return joints.length ? loads.hardest.t : verdict.window.from;
}
