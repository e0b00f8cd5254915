// Texts of the page around its panels: title, verdict, definitions, origin of the runs.
import { about, explained, title } from "./about";
import { element, make } from "../dom";
import { folder } from "../data/folder";
import type { Meta } from "../data/format";
import { headline } from "./headline";
import { number } from "../data/numbers";
import type { Desk } from "../panel";

export function captions(desk: Desk): void {
  const { meta } = desk.recording;
  const ran = meta.outcome !== "not run";
  const twoRuns = desk.ghost && !desk.ghost.overlay.strayed;
  const name = title(desk.runs);
  element("name").textContent = name;
  document.title = `${name}: gaitlab report`;
  element("about").textContent = twoRuns ? "" : about(meta);
  document.documentElement.classList.toggle("planned", !ran);
  headline(desk);
  element("foot-text").textContent = origin(desk).join(" ");
  element("scenario").textContent = meta.scenario;
  element("definitions").parentElement!.hidden = !ran || !meta.verdict.checks.length;
  if (ran) element("definitions").append(...definitions(meta));
}

/** General explanations, and the definition of each check. */
function definitions(meta: Meta): HTMLElement[] {
  const { window, checks } = meta.verdict;
  const defined = checks.filter((c) => c.definition);
  return [
    ...explained(meta).map((text) => make("p", text)),
    make(
      "p",
      `Judged from ${number(window.from, 4)} to ${number(window.to, 4)} s; limits that break parts at once ` +
        "(docks, gears, stops, collisions, falls) in the whole run, including its start.",
    ),
    make(
      "ul",
      ...defined.map((c) =>
        make("li", make("b", c.title), `: ${c.definition}${c.source ? ` (limit: ${c.source})` : ""}`),
      ),
    ),
  ];
}

/** One sentence each for the version of the program, the hashes of the traces, and the command that repeats the run. */
function origin({ recording: { meta }, runs, ghost }: Desk): string[] {
  const overlay = ghost?.overlay;
  const builds = new Set(runs.map((r) => r.recording.meta.build));
  const made = `gaitlab ${[...builds].join(" and ")}.`;
  if (meta.outcome === "not run" || overlay?.strayed) return [made];
  const hashes = runs.map(
    (r, n) => `${overlay ? `${overlay.labels[n]} ` : ""}${r.recording.meta.summary.trace_hash ?? "unknown"}`,
  );
  return [
    made,
    `Trace hash: ${hashes.join(", ")}.`,
    "Values on this page are rounded. The trace has them in full.",
    `The same run again: ${meta.command.replace("FOLDER", folder(meta))}`,
  ];
}
