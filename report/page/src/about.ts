// What was run, in a line.
import type { Meta } from "./format";
import { number, plural, quantity } from "./numbers";
import type { Run } from "./panel";

/** What was run, in one line. */
export function about(meta: Meta): string {
  const ran = meta.outcome !== "not run", step = meta.step !== null ? `step ${quantity(1000 * meta.step, "ms")}` : meta.accuracy !== null ? `accuracy ${number(meta.accuracy)}` : "";
  return [
    `${plural(meta.modules.length, "module")}, ${plural(meta.joints.length, "joint")}, ${quantity(meta.mass, "kg")}`,
    ...(ran ? [`${meta.cpg}${meta.frequency ? ` at ${quantity(meta.frequency, "Hz")}` : ""}`, quantity(meta.duration, "s")] : []),
    `engine ${meta.engine}${ran ? `, ${meta.integrator}` : ""}${step ? `, ${step}` : ""}`,
  ].filter(Boolean).join(" · ");
}

/** The names of the runs; where both have one, the name and what tells them apart. */
export function title(runs: readonly Run[]): string {
  const [own, second] = runs.map((r) => r.recording.meta.name), overlay = runs[0].recording.meta.overlay;
  if (!overlay || second === undefined) return own;
  return own === second ? `${own}: ${overlay.labels.join(" and ")}` : `${overlay.labels[0]} ${own}, ${overlay.labels[1]} ${second}`;
}

/** What active and passive stand for; "" where no block is called so. */
export const blocks = (meta: Meta): string => (meta.bodies.some((b) => b.role === "active" || b.role === "passive")
  ? "Active and passive are the two blocks of a module. The faces of an active block connect to the passive faces of other modules. The hinge m3/active is the one at the active block of module m3."
  : "");

/** How the page is to be read, a sentence or two each. */
export const explained = (meta: Meta): string[] => [
  "A check fails where a limit of the robot is exceeded. It warns where little of a limit is left, and where what it finds harms no part of the robot: feet that slip cost way, but break nothing. It is too close where the limit lies within the error of the number. Whether the numbers can be believed is told apart, and makes no gait infeasible.",
  `Plots, heat map and table of docks are of the rows on this page, ${number(1000 * meta.period)} ms apart. A peak between two rows counts in the checks of motors, which are of all steps, but is not drawn.`,
  blocks(meta),
].filter(Boolean);
