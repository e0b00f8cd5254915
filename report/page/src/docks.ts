// What the docks hold, worst first; without loads: which face sits on which.
import { element, make } from "./dom";
import { number } from "./numbers";
import type { Desk } from "./panel";
import { dockName } from "./places";
import type { Recording } from "./recording";

const kinds = [["tension", "N"], ["shear", "N"], ["bending", "N m"], ["torsion", "N m"]] as const;
const few = 12;

export function docks(desk: Desk): void {
  const { recording, ghost } = desk, { meta } = recording, table = element<HTMLTableElement>("docks");
  const shown = kinds.filter(([k]) => recording.has(`dock.0.${k}`));
  if (!shown.length) {
    element("docks-note").textContent = "The recording has no loads of docks.";
    table.append(...joins(desk));
    shorten(table);
    return;
  }
  element("docks-note").textContent = `largest of the rows in the judged window${ghost ? `; below, thin: ${ghost.label}` : ""}`;
  const peaks = meta.docks.map((_, n) => shown.map(([kind]) => peak(recording, n, kind)));
  const second = meta.docks.map((_, n) => (ghost && ghost.number("dock", n) >= 0 && ghost.recording.has(`dock.0.${kinds[0][0]}`) ? shown.map(([kind]) => peak(ghost.recording, ghost.number("dock", n), kind)) : null));
  const largest = shown.map((_, k) => Math.max(...peaks.map((p) => p[k]), ...second.map((p) => p?.[k] ?? 0), 1e-6)), by = shown.findIndex(([k]) => k === "bending");
  const order = meta.docks.map((_, n) => n).sort((a, b) => peaks[b][Math.max(by, 0)] - peaks[a][Math.max(by, 0)]);
  const load = (value: number, k: number) => number(value, 3, shown[k][1]);
  const bar = (value: number, most: number, ...text: HTMLElement[]): HTMLElement => {
    const fill = make("i");
    fill.style.width = `${(100 * value / most).toFixed(1)}%`;
    return make("span.bar", fill, ...text);
  };
  const body = make("tbody", ...order.map((n) => make("tr", head(desk, n), ...shown.map((_, k) => {
      const theirs = second[n]?.[k], cell = make("td", bar(peaks[n][k], largest[k], make("span", load(peaks[n][k], k) + (theirs === undefined ? "" : ` · ${load(theirs, k)}`))));
      if (theirs !== undefined) cell.append(bar(theirs, largest[k]));
      return cell;
    }))));
  table.append(make("thead", make("tr", make("th", "dock"), ...shown.map(([kind, unit]) => make("th", kind, make("small", ` ${unit}`))))), body);
  shorten(table);
}

function peak(recording: Recording, dock: number, kind: string): number {
  let most = 0;
  recording.channel(`dock.${dock}.${kind}`).forEach((v, i) => { if (i >= recording.judged) most = Math.max(most, kind === "tension" ? v : Math.abs(v)); });
  return most;
}

/** A dozen rows, and a button for all. */
function shorten(table: HTMLTableElement): void {
  const rows = [...table.tBodies[0].rows];
  if (rows.length <= few) return;
  const all = make("button", `All ${rows.length} docks`), show = (shown: boolean) => rows.slice(few).forEach((r) => { r.hidden = !shown; });
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
  const { docks: all, modules } = desk.recording.meta, { name, module, parent, face, parent_face } = all[n], cell = make("th", marker(desk, n, dockName(name)));
  cell.scope = "row";
  cell.title = `face ${face} of ${modules[module]?.name ?? name} on face ${parent_face} of ${modules[parent]?.name ?? "?"}`;
  return cell;
}

/** A button that marks a dock in 3D. */
function marker(desk: Desk, n: number, text: string): HTMLElement {
  const button = make("button.link", text);
  button.type = "button";
  button.addEventListener("click", () => {
    desk.mark(n);
    element("stage").scrollIntoView({ block: "nearest" });
  });
  return button;
}

/** Rows that say which face sits on which. */
export function joins(desk: Desk): HTMLElement[] {
  const { docks: all, modules } = desk.recording.meta;
  return [
    make("thead", make("tr", make("th", "module"), make("th", "its face"), make("th", "on face"), make("th", "of"))),
    make("tbody", ...all.map((d, n) => {
      const name = make("th", marker(desk, n, modules[d.module]?.name ?? d.name));
      name.scope = "row";
      return make("tr", name, make("td", String(d.face)), make("td", String(d.parent_face)), make("td", modules[d.parent]?.name ?? "–"));
    })),
  ];
}
