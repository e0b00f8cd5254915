// Table of the docks, sorted by load. If the recording has no loads, the table lists the two faces at each dock.
import { element, link, make, rowHead, tableHead } from "../dom";
import { number } from "../data/numbers";
import type { Desk } from "../panel";
import { dockName } from "../data/places";
import type { Recording } from "../data/recording";

const kinds = [
  ["tension", "N"],
  ["shear", "N"],
  ["bending", "N m"],
  ["torsion", "N m"],
] as const;
type Kind = (typeof kinds)[number];
const few = 12;

export function docks(desk: Desk): void {
  const table = element<HTMLTableElement>("docks");
  const note = element("docks-note");
  const shown = kinds.filter(([k]) => desk.recording.has(`dock.0.${k}`));
  if (shown.length) {
    const below = desk.ghost ? `; below, thin: ${desk.ghost.label}` : "";
    note.textContent = `largest of the rows in the judged window${below}`;
    table.append(tableHead(["dock"], ...shown), loads(desk, shown));
  } else {
    note.textContent = "The recording has no loads of docks.";
    table.append(...joins(desk));
  }
  shorten(table);
}

/** Rows of the docks with their largest loads, sorted by bending, or by the first recorded load without bending. */
function loads(desk: Desk, shown: readonly Kind[]): HTMLElement {
  const { docks: all } = desk.recording.meta;
  const own = all.map((_, n) => peaks(desk.recording, n, shown));
  const second = all.map((_, n) => peaksOfSecond(desk, n, shown));
  const largest = shown.map((_, k) => Math.max(...own.map((p) => p[k]), ...second.map((p) => p?.[k] ?? 0), 1e-6));
  const by = Math.max(
    shown.findIndex(([k]) => k === "bending"),
    0,
  );
  const order = all.map((_, n) => n).sort((a, b) => own[b][by] - own[a][by]);
  const cells = (n: number) => shown.map(([, unit], k) => cell(unit, largest[k], own[n][k], second[n]?.[k]));
  return make("tbody", ...order.map((n) => make("tr", head(desk, n), ...cells(n))));
}

/** Cell with a load as number and bar, and for two runs with the loads of both. A full bar is the load `largest`. */
function cell(unit: string, largest: number, own: number, second?: number): HTMLElement {
  const text = (value: number) => number(value, 3, unit);
  const bar = (value: number, ...words: HTMLElement[]): HTMLElement => {
    const fill = make("i");
    fill.style.width = `${((100 * value) / largest).toFixed(1)}%`;
    return make("span.bar", fill, ...words);
  };
  const made = make("td", bar(own, make("span", text(own) + (second === undefined ? "" : ` · ${text(second)}`))));
  if (second !== undefined) made.append(bar(second));
  return made;
}

const peaks = (recording: Recording, dock: number, shown: readonly Kind[]): number[] =>
  shown.map(([kind]) => peak(recording, dock, kind));

/** Largest loads of the dock of that name in the second run; null if the second run has no such dock or no loads. */
function peaksOfSecond({ ghost }: Desk, dock: number, shown: readonly Kind[]): number[] | null {
  const theirs = ghost?.number("dock", dock) ?? -1;
  return ghost && theirs >= 0 && ghost.recording.has(`dock.0.${kinds[0][0]}`)
    ? peaks(ghost.recording, theirs, shown)
    : null;
}
function peak(recording: Recording, dock: number, kind: string): number {
  let most = 0;
  recording.channel(`dock.${dock}.${kind}`).forEach((v, i) => {
    if (i >= recording.judged) most = Math.max(most, kind === "tension" ? v : Math.abs(v));
  });
  return most;
}

/** Hides all rows but the first twelve, and adds a button that shows all rows. */
function shorten(table: HTMLTableElement): void {
  const rows = [...table.tBodies[0].rows];
  if (rows.length <= few) return;
  const all = make("button", `All ${rows.length} docks`);
  const show = (shown: boolean) =>
    rows.slice(few).forEach((r) => {
      r.hidden = !shown;
    });
  all.type = "button";
  all.addEventListener("click", () => {
    show(true);
    table.parentElement!.classList.add("scroll");
    all.remove();
  });
  show(false);
  table.after(all);
}

function head(desk: Desk, n: number): HTMLTableCellElement {
  const { docks: all, modules } = desk.recording.meta;
  const { name, module, parent, face, parent_face } = all[n];
  const cell = rowHead(marker(desk, n, dockName(name)));
  const own = `face ${face} of ${modules[module]?.name ?? name}`;
  cell.title = `${own} on face ${parent_face} of ${modules[parent]?.name ?? "?"}`;
  return cell;
}

/** Button that marks a dock in the 3D picture. */
const marker = (desk: Desk, n: number, text: string): HTMLElement =>
  link(text, () => {
    desk.mark("dock", desk.recording.meta.docks[n].name);
    element("stage").scrollIntoView({ block: "nearest" });
  });

/** Head and rows of a table with the two faces at each dock. */
export function joins(desk: Desk): HTMLElement[] {
  const { docks: all, modules } = desk.recording.meta;
  return [
    tableHead(["module"], ["its face"], ["on face"], ["of"]),
    make(
      "tbody",
      ...all.map((d, n) =>
        make(
          "tr",
          rowHead(marker(desk, n, modules[d.module]?.name ?? d.name)),
          make("td", String(d.face)),
          make("td", String(d.parent_face)),
          make("td", modules[d.parent]?.name ?? "–"),
        ),
      ),
    ),
  ];
}
