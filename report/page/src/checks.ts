// The table of checks. A row opens what was held against what, and goes to its joint and time.
import { element, icon, make } from "./dom";
import type { Check, Status } from "./format";
import { quantity, span } from "./numbers";
import type { Desk } from "./panel";

const marks: Record<Status, string> = {
  pass: "M3 8.5l3.4 3.4L13 4.6", warn: "M8 2.6L14.4 13.4H1.6zM8 7v2.6M8 11.5v.1", fail: "M4 4l8 8M12 4l-8 8", "not judged": "M5.6 6a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.2.9-1.2 1.7M8 12.6v.1",
};
const words: Record<Status, string> = { pass: "pass", warn: "warning", fail: "fail", "not judged": "not judged" };
/** On a figure that nobody but the project states. */
export const rests = (source: string): boolean => /^(.* of the scenario; the rest: )?chosen/.test(source);
/** Checks whose limit is the least that may be found; of the others it is the most. */
const least = new Set(["outcome", "fall"]);
const groups: Record<string, string> = { run: "The run", motor: "Motors", motion: "Motion", structure: "Structure", ground: "Ground", trust: "Can the numbers be believed?" };

/** The same check of every run; undefined where one was not checked for it. */
type Row = (Check | undefined)[];

export function checks(desk: Desk): void {
  const { runs, ghost } = desk, body = element<HTMLTableSectionElement>("checks"), verdicts = runs.map((r) => r.recording.meta.verdict);
  const ids = new Map<string, Row>(); // the second run's own stand behind those of their group
  verdicts.forEach((v, n) => v.checks.forEach((c) => ids.set(c.id, Object.assign(ids.get(c.id) ?? runs.map(() => undefined), { [n]: c }))));
  const rows = [...ids.values()], first = (row: Row) => row.find((c) => c)!, order = [...new Set(rows.map((r) => first(r).group))];
  const head = element<HTMLTableElement>("checks").closest("table")!.tHead!.rows[0];
  if (ghost) {
    const columns = ghost.overlay.labels.map((label) => make("th", label));
    columns.forEach((c) => { c.scope = "col"; });
    head.cells[2].replaceWith(...columns);
  }
  for (const group of order) {
    const name = make("th", groups[group] ?? group);
    name.colSpan = head.cells.length;
    name.scope = "colgroup";
    body.append(make("tr.group", name));
    for (const row of rows) if (first(row).group === group) body.append(...drawn(desk, row));
  }
  const chosen = verdicts.some((v) => v.checks.some((c) => c.limit !== null && rests(c.source)));
  element("checks-note").textContent = chosen ? "* rests on a figure that is chosen, not a maker's; a row that is opened says which" : "";
  element("counts").textContent = verdicts.map(({ counts: { pass, warn, fail, "not judged": open } }, n) => `${ghost ? `${ghost.overlay.labels[n]}: ` : ""}${
    [[pass, "passed"], [warn, warn === 1 ? "warning" : "warnings"], [fail, "failed"], [open, "not judged"]].filter(([k]) => k).map(([k, word]) => `${k} ${word}`).join(", ")}`).join("; ");
}

const worst = (row: Row): Status => (["fail", "warn", "pass", "not judged"] as const).find((s) => row.some((c) => c?.status === s)) ?? "not judged";
const aloud = (check: Check): boolean => check.status === "warn" || check.status === "fail";

/** What an opened row says of one run; `label`: which, where there are two. */
function more(check: Check, label: string): HTMLElement[] {
  const { joint, from, to, text, definition, source } = check, where = [joint ?? "", from !== null ? span(from, to ?? from) : ""].filter(Boolean).join(", ");
  return [...(where ? [make("p", make("b", label + where))] : []), ...(aloud(check) ? [] : [make("p", label + sentence(text))]),
    ...(definition ? [make("p", sentence(definition))] : []), ...(source ? [make("p", sentence(`limit: ${source}`))] : [])];
}

function limitOf({ id, limit, unit, source }: Check): string {
  return limit === null ? "no limit" : (least.has(id) ? "≥ " : "") + quantity(limit, unit) + (rests(source) ? "*" : "");
}

function drawn(desk: Desk, row: Row): HTMLTableRowElement[] {
  const two = desk.ghost?.overlay.labels, label = (n: number) => (two ? `${two[n]}: ` : ""), first = row.find((c) => c)!, status = worst(row), mark = (c: Check) => [icon(marks[c.status]), make("span.sr", words[c.status])];
  const open = make("button.link", first.title || first.id), added = make("div.more"), limits = [...new Set(row.flatMap((c) => (c ? [limitOf(c)] : [])))];
  open.type = "button";
  open.setAttribute("aria-expanded", "false");
  // Of two runs the definition stands once.
  row.forEach((c, n) => { if (c) added.append(...more(n > 0 && row[0] ? { ...c, definition: "", source: c.source === row[0].source ? "" : c.source } : c, label(n))); });
  added.hidden = true;
  const values = row.map((c) => {
    const cell = make("td.value", ...(two && c ? [...mark(c), " "] : []), !c ? "–" : c.value === null ? "not judged" : quantity(c.value, c.unit));
    if (two && c) cell.classList.add(`is-${c.status.replace(" ", "-")}`);
    return cell;
  });
  const head = make("tr", make("td.mark", ...(two ? [] : mark(first))), make("td.what", open), ...values, make("td.limit", limits.join("; ")));
  const told = row.flatMap((c, n) => (c ? [...(aloud(c) ? [make("p.why", label(n) + sentence(c.text))] : []), ...(c.missing ? [make("p.short", `${label(n)}Missing: ${c.missing}`)] : [])] : []));
  const text = make("td", ...told, added), detail = make("tr", make("td"), text);
  text.colSpan = 2 + values.length;
  detail.hidden = !told.length;
  const run = desk.runs[Math.max(row.findIndex((c) => c?.status === status), 0)], place = row.find((c) => c?.status === status) ?? first;
  for (const one of [head, detail]) {
    one.className = `is-${status.replace(" ", "-")}`;
    one.classList.toggle("detail", one === detail);
    one.addEventListener("click", () => {
      const shown = !added.hidden, joint = run.recording.meta.joints.findIndex((j) => j.name === place.joint);
      element("checks").dispatchEvent(new Event("close"));
      added.hidden = shown;
      detail.hidden = shown && !told.length;
      open.setAttribute("aria-expanded", String(!shown));
      if (joint >= 0) run.choose(joint);
      if (place.from !== null) run.goTo(place.from);
    });
  }
  element("checks").addEventListener("close", () => {
    added.hidden = true;
    detail.hidden = !told.length;
    open.setAttribute("aria-expanded", "false");
  });
  head.dataset.check = first.id;
  return [head, detail];
}

const sentence = (text: string): string => (text ? text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".") : "");
