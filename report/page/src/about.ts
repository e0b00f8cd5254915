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
