// What the docks hold, worst first; without loads: which face sits on which.
import { element, make } from "./dom";
import { number } from "./numbers";
import type { Recording } from "./recording";

const kinds = [["tension", "N"], ["shear", "N"], ["bending", "N m"], ["torsion", "N m"]] as const;
const few = 12;

export function docks(recording: Recording): void {
  const { meta } = recording, table = element<HTMLTableElement>("docks"), from = recording.judged;
  const shown = kinds.filter(([k]) => recording.has(`dock.0.${k}`));
  if (!shown.length) {
    element("docks-note").textContent = "The recording has no loads of docks.";
    table.append(...joins(recording));
    shorten(table);
    return;
  }
  element("docks-note").textContent = "largest in the judged window";
  const peaks = meta.docks.map((_, n) => shown.map(([kind]) => {
    let most = 0;
    recording.channel(`dock.${n}.${kind}`).forEach((v, i) => { if (i >= from) most = Math.max(most, kind === "tension" ? v : Math.abs(v)); });
    return most;
  }));
  const largest = shown.map((_, k) => Math.max(...peaks.map((p) => p[k]), 1e-9)), by = shown.findIndex(([k]) => k === "bending");
  const order = meta.docks.map((_, n) => n).sort((a, b) => peaks[b][Math.max(by, 0)] - peaks[a][Math.max(by, 0)]);
  const body = make("tbody", ...order.map((n) => make("tr", head(recording, n), ...shown.map((_, k) => {
      const fill = make("i"), value = peaks[n][k];
      fill.style.width = `${(100 * value / largest[k]).toFixed(1)}%`;
      return make("td", make("span.bar", fill, make("span", number(value))));
    }))));
  table.append(make("thead", make("tr", make("th", "dock"), ...shown.map(([kind, unit]) => make("th", kind, make("small", ` ${unit}`))))), body);
  shorten(table);
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

function head(recording: Recording, n: number): HTMLTableCellElement {
  const { name, module, parent, face, parent_face } = recording.meta.docks[n], cell = make("th", name), { modules } = recording.meta;
  cell.scope = "row";
  cell.title = `face ${face} of ${modules[module]?.name ?? name} on face ${parent_face} of ${modules[parent]?.name ?? "?"}`;
  return cell;
}

/** Rows that say which face sits on which. */
export function joins(recording: Recording): HTMLElement[] {
  const { docks: all, modules } = recording.meta;
  return [
    make("thead", make("tr", make("th", "module"), make("th", "its face"), make("th", "on face"), make("th", "of"))),
    make("tbody", ...all.map((d) => {
      const name = make("th", modules[d.module]?.name ?? d.name);
      name.scope = "row";
      return make("tr", name, make("td", String(d.face)), make("td", String(d.parent_face)), make("td", modules[d.parent]?.name ?? "–"));
    })),
  ];
}
