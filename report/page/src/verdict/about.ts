// Short descriptions of a run: its robot and engine, its title, the terms of the page.
import type { Meta } from "../data/format";
import { number, plural, quantity } from "../data/numbers";
import type { Run } from "../panel";

/** Robot, gait, duration and engine of a run in one line. */
export function about(meta: Meta): string {
  const ran = meta.outcome !== "not run";
  const step =
    meta.step !== null
      ? `step ${quantity(1000 * meta.step, "ms")}`
      : meta.accuracy !== null
        ? `accuracy ${number(meta.accuracy)}`
        : "";
  return [
    `${plural(meta.modules.length, "module")}, ${plural(meta.joints.length, "joint")}, ${quantity(meta.mass, "kg")}`,
    ...(ran
      ? [`${meta.cpg}${meta.frequency ? ` at ${quantity(meta.frequency, "Hz")}` : ""}`, quantity(meta.duration, "s")]
      : []),
    `engine ${meta.engine}${ran ? `, ${meta.integrator}` : ""}${step ? `, ${step}` : ""}`,
  ]
    .filter(Boolean)
    .join(" · ");
}

/** Title of the page: the name of the run, or the names of both runs, with their folders if the names are equal. */
export function title(runs: readonly Run[]): string {
  const [own, second] = runs.map((r) => r.recording.meta.name);
  const overlay = runs[0].recording.meta.overlay;
  if (!overlay || second === undefined) return own;
  return own === second
    ? `${own}: ${(overlay.strayed ? overlay.labels : overlay.folders).join(" and ")}`
    : `${overlay.labels[0]} ${own}, ${overlay.labels[1]} ${second}`;
}

/** Definition of active and passive blocks; "" for a robot without such blocks. */
export const blocks = (meta: Meta): string =>
  meta.bodies.some((b) => b.role === "active" || b.role === "passive")
    ? "Active and passive are the two blocks of a module. The faces of an active block connect to the passive faces " +
      "of other modules. The hinge m3/active is the one at the active block of module m3."
    : "";

/** Explanations of the page, a paragraph each. */
export const explained = (meta: Meta): string[] =>
  [
    "A check fails if a limit of the robot is exceeded. It warns if a value is close to its limit, or if the finding " +
      "does not damage the robot: slipping feet cost distance, but break nothing. It is too close if the limit is " +
      "within the error of the value. Checks of the accuracy of the numbers are listed separately and never make a " +
      "gait infeasible.",
    `Plots, heat map and table of docks use the rows on this page, ${number(1000 * meta.period)} ms apart. ` +
      "A peak between two rows counts in the checks of motors, which use all steps, but is not drawn.",
    blocks(meta),
  ].filter(Boolean);
