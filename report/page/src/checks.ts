// The table of checks. A row opens what was held against what, and goes to its joint and time.
import { element, icon, make } from "./dom";
import type { Check, Status } from "./format";
import { plural, quantity, sentence, span } from "./numbers";
import type { Desk } from "./panel";
import { moment, partName, show } from "./places";

const marks: Record<Status, string> = {
  pass: "M3 8.5l3.4 3.4L13 4.6", warn: "M8 2.6L14.4 13.4H1.6zM8 7v2.6M8 11.5v.1", fail: "M4 4l8 8M12 4l-8 8", "too close": "M2.6 6.6c1.8-2 3.6-2 5.4 0s3.6 2 5.4 0M2.6 11c1.8-2 3.6-2 5.4 0s3.6 2 5.4 0", "not judged": "M5.6 6a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.2.9-1.2 1.7M8 12.6v.1",
};
const words: Record<Status, string> = { pass: "pass", warn: "warning", fail: "fail", "too close": "too close", "not judged": "not judged" };
/** On a figure that nobody but the project states. */
export const rests = (source: string): boolean => /^(.* of the scenario; the rest: )?chosen/.test(source);
/** What is found without being held against anything: it has neither passed nor failed. */
const notes = new Set(["stability"]);
const noted = (check: Check): boolean => notes.has(check.id) && check.status === "pass";
const given = (status: Status): string => `is-${status.replace(" ", "-")}`;
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
  const tried = new Set<string>(), folded: HTMLTableRowElement[] = [], open = rows.filter((row) => worst(row) === "not judged");
  for (const group of order) {
    const name = make("th", groups[group] ?? group), title = make("tr.group", name), own = rows.filter((row) => first(row).group === group);
    name.colSpan = head.cells.length;
    name.scope = "colgroup";
    body.append(title);
    if (own.every((row) => open.includes(row))) folded.push(title);
    for (const row of own) {
      const made = drawn(desk, row, tried);
      if (open.includes(row)) folded.push(made[0]);
      body.append(...made);
    }
  }
  if (open.length > 1) body.append(fold(open.map(first), folded, head.cells.length));
  const chosen = verdicts.some((v) => v.checks.some((c) => c.limit !== null && rests(c.source)));
  element("checks-note").textContent = chosen ? "* rests on a figure that is chosen, not a maker's; a row that is opened says which" : "";
  element("counts").textContent = verdicts.map(({ checks: all, counts: { pass, warn, fail, "too close": close, "not judged": unknown } }, n) => `${ghost ? `${ghost.overlay.labels[n]}: ` : ""}${
    [[fail, "failed"], [close, "too close"], [warn, warn === 1 ? "warning" : "warnings"], [pass - all.filter(noted).length, "passed"], [unknown, "not judged"]].filter(([k]) => k).map(([k, word]) => `${k} ${word}`).join(", ")}`).join("; ");
}

/** One line for the checks that were not judged, which shows and hides them. */
function fold(open: Check[], rows: HTMLTableRowElement[], columns: number): HTMLTableRowElement {
  const button = make("button.link", `${plural(open.length, "check")} not judged`), cell = make("td", button), line = make("tr.fold", make("td.mark", icon(marks["not judged"])), cell);
  const set = (shown: boolean) => {
    rows.forEach((row) => { row.hidden = !shown; });
    button.setAttribute("aria-expanded", String(shown));
  };
  cell.colSpan = columns - 1;
  button.type = "button";
  line.classList.add(given("not judged"));
  line.addEventListener("click", () => {
    element("checks").dispatchEvent(new Event("close"));
    set(rows[0].hidden);
  });
  set(false);
  return line;
}

const worst = (row: Row): Status => (["fail", "too close", "warn", "pass", "not judged"] as const).find((s) => row.some((c) => c?.status === s)) ?? "not judged";
const aloud = (check: Check): boolean => check.status !== "pass" && check.status !== "not judged";

/** What an opened row says of one run; `label`: which, where there are two. */
function more(check: Check, label: string, called: string, text: string): HTMLElement[] {
  const { from, to, definition, source } = check, where = [called, from !== null ? span(from, to ?? from) : ""].filter(Boolean).join(", ");
  return [...(where ? [make("p", make("b", label + where))] : []), ...(aloud(check) ? [] : [make("p", label + sentence(text))]),
    ...(definition ? [make("p", sentence(definition))] : []), ...(source ? [make("p", sentence(`limit: ${source}`))] : [])];
}

/** What to set, or what helps in general. */
function remedy({ status, group, remedy: own, advice }: Check): string {
  const tried = (own || (group === "run" ? "" : advice)).replace(/^take /, "").replace(/[.]$/, "");
  return (status === "fail" || status === "too close") && tried ? `Try: ${tried}.` : "";
}

function limitOf(check: Check): string {
  const { limit, least, unit, source } = check;
  return limit === null ? (noted(check) ? "a note" : check.status === "pass" ? "–" : "no limit") : (least ? "≥ " : "") + quantity(limit, unit) + (rests(source) ? "*" : "");
}

function drawn(desk: Desk, row: Row, tried: Set<string>): HTMLTableRowElement[] {
  const two = desk.ghost?.overlay.labels, label = (n: number) => (two ? `${two[n]}: ` : ""), first = row.find((c) => c)!, status = worst(row), mark = (c: Check) => (noted(c) ? [make("span.sr", "a note")] : [icon(marks[c.status]), make("span.sr", words[c.status])]);
  const called = (c: Check, n: number) => (c.worst === null ? "" : partName(desk.runs[n].recording.meta, c.part, c.worst));
  const open = make("button.link", first.title || first.id), added = make("div.more"), limits = [...new Set(row.flatMap((c) => (c ? [limitOf(c)] : [])))];
  open.type = "button";
  open.setAttribute("aria-expanded", "false");
  // Of two runs the definition stands once.
  row.forEach((c, n) => { if (c) added.append(...more(n > 0 && row[0] ? { ...c, definition: "", source: c.source === row[0].source ? "" : c.source } : c, label(n), called(c, n), c.text)); });
  added.hidden = true;
  const values = row.map((c) => {
    const cell = make("td.value", ...(two && c ? [...mark(c), " "] : []), !c ? "–" : c.value === null ? "not judged" : quantity(c.value, c.unit));
    if (two && c) cell.classList.add(given(c.status));
    return cell;
  });
  const head = make("tr", make("td.mark", ...(two ? [] : mark(first))), make("td.what", open), ...values, make("td.limit", limits.join("; ")));
  // The same advice stands once.
  const advised = (advice: string) => {
    tried.add(advice);
    return make("p.try", advice);
  };
  const told = row.flatMap((c, n) => (c ? [...(aloud(c) ? [make("p.why", label(n) + sentence(c.text))] : []), ...(c.missing ? [make("p.short", `${label(n)}Missing: ${c.missing}`)] : []), ...(remedy(c) && !tried.has(label(n) + remedy(c)) ? [advised(label(n) + remedy(c))] : [])] : []));
  const text = make("td", ...told, added), detail = make("tr", make("td"), text);
  text.colSpan = 2 + values.length;
  detail.hidden = !told.length;
  const run = desk.runs[Math.max(row.findIndex((c) => c?.status === status), 0)], place = row.find((c) => c?.status === status) ?? first;
  for (const one of [head, detail]) {
    one.className = given(status);
    one.classList.toggle("detail", one === detail);
    one.addEventListener("click", () => {
      const shown = !added.hidden;
      element("checks").dispatchEvent(new Event("close"));
      added.hidden = shown;
      detail.hidden = shown && !told.length;
      open.setAttribute("aria-expanded", String(!shown));
      show(run, place.part, place.worst, moment(run, place));
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
