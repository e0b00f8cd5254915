// Selection of the panels: only panels with data in the recording are shown.
import { blocks } from "./verdict/about";
import { Balance } from "./plots/balance";
import { checks } from "./verdict/checks";
import { demand } from "./verdict/demand";
import { docks } from "./verdict/docks";
import { element, panelOf } from "./dom";
import { Energy } from "./plots/energy";
import { Envelope } from "./plots/envelope";
import { Footfalls } from "./plots/footfalls";
import { HeatMap } from "./plots/heatmap";
import { JointPlots } from "./plots/joint_plots";
import { Overview } from "./plots/overview";
import type { Desk, Panel } from "./panel";
import { parts } from "./verdict/parts";
import { Path } from "./plots/path";
import { Phases } from "./plots/phases";
import { remedy } from "./verdict/remedy";
import { Strays } from "./plots/strays";

/** Fills the tables, and returns the panels that change with time or joint. */
export function arrange(desk: Desk): Panel[] {
  const { meta } = desk.recording;
  element("joint").title = blocks(meta);
  for (const [n, joint] of meta.joints.entries()) {
    element("joint").append(new Option(`${n}  ${joint.name}`, String(n)));
  }
  tables(desk);
  const panels = plots(desk);
  // Goldens omit the data of some panels intentionally. The list of omitted panels is therefore hidden.
  if (desk.ghost?.overlay.strayed) element("left-out").hidden = true;
  closeRows();
  return panels;
}

/** Hides a panel unless the condition holds; returns the condition. */
function keep(id: string, when: boolean): boolean {
  panelOf(id).hidden = !when;
  return when;
}

function tables(desk: Desk): void {
  const { recording, runs, ghost } = desk;
  const run = recording.meta.outcome !== "not run";
  const verdicts = runs.map((r) => r.recording.meta.verdict);
  const found = ghost ? undefined : verdicts[0].remedy;
  if (keep("remedy", !!found) && found) remedy(found);
  const demanded = verdicts.some((v) => v.demand?.joints.length);
  if (keep("checks", run && verdicts.some((v) => v.checks.length > 0))) checks(desk);
  if (keep("demand", demanded)) demand(desk);
  if (keep("parts", !run)) parts(desk);
  if (keep("docks", recording.ran && recording.meta.docks.length > 0 && !ghost?.overlay.strayed)) docks(desk);
}

function plots(desk: Desk): Panel[] {
  const { recording, ghost } = desk;
  const { joints, ground } = recording.meta;
  const { ran } = recording;
  const jointed = ran && joints.length > 0;
  const grounded = ran && ground.kind !== "none";
  const strayed = !!ghost?.overlay.strayed;
  keep("drift", strayed);
  return [
    ...(keep("strays", strayed) ? [new Strays(desk)] : []),
    ...(ran ? [new Overview(desk)] : []),
    ...(keep("motion", jointed) ? [new JointPlots(desk)] : []),
    ...(keep("envelope", jointed) ? [new Envelope(desk)] : []),
    ...(keep("heat", jointed) ? [new HeatMap(desk)] : []),
    ...(keep("foot", grounded) ? [new Footfalls(desk)] : []),
    ...(keep("path", grounded) ? [new Path(desk), new Balance(desk)] : []),
    ...(keep("phase", jointed) ? [new Phases(desk)] : []),
    ...(keep("energy", jointed) ? [new Energy(desk)] : []),
  ];
}

/** Hides rows in which all panels are hidden. */
function closeRows(): void {
  for (const row of document.querySelectorAll<HTMLElement>(".row")) {
    const shown = [...row.children].filter((c) => !(c as HTMLElement).hidden).length;
    row.hidden = !shown;
    row.dataset.panels = String(shown);
  }
}
