// Table of checks. A click on a row opens its definition and source, and shows its joint and time.
import { element, icon, link, make } from "../dom";
import type { Check, Status, Verdict } from "../data/format";
import { plural, quantity, sentence, span } from "../data/numbers";
import type { Desk } from "../panel";
import { show } from "./place";
import { moment, partName } from "../data/places";

const marks: Record<Status, string> = {
  pass: "M3 8.5l3.4 3.4L13 4.6",
  warn: "M8 2.6L14.4 13.4H1.6zM8 7v2.6M8 11.5v.1",
  fail: "M4 4l8 8M12 4l-8 8",
  "too close": "M2.6 6.6c1.8-2 3.6-2 5.4 0s3.6 2 5.4 0M2.6 11c1.8-2 3.6-2 5.4 0s3.6 2 5.4 0",
  "not judged": "M5.6 6a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.2.9-1.2 1.7M8 12.6v.1",
};
const words: Record<Status, string> = {
  pass: "pass",
  warn: "warning",
  fail: "fail",
  "too close": "too close",
  "not judged": "not judged",
};
/** True for a limit that uses a value chosen by this project, without a published source. */
const rests = (source: string): boolean => /^(.* of the scenario; the rest: )?chosen/.test(source);
/** Findings without a limit, which neither pass nor fail. */
const notes = new Set(["stability"]);
const noted = (check: Check): boolean => notes.has(check.id) && check.status === "pass";
const given = (status: Status): string => `is-${status.replace(" ", "-")}`;
const groups: Record<string, string> = {
  run: "The run",
  motor: "Motors",
  motion: "Motion",
  structure: "Structure",
  ground: "Ground",
  trust: "Are the numbers accurate?",
};

/** One check in each run of the page. An element is undefined if its run does not have the check. */
type Row = (Check | undefined)[];

export function checks(desk: Desk): void {
  const verdicts = desk.runs.map((r) => r.recording.meta.verdict);
  const columns = nameColumns(desk);
  fill(desk, rowsOf(verdicts), columns);
  const chosen = verdicts.some((v) => v.checks.some((c) => c.limit !== null && rests(c.source)));
  element("checks-note").textContent = chosen
    ? "* uses a value that is chosen, not the manufacturer's; expand a row to see which"
    : "";
  element("counts").textContent = verdicts.map((v, n) => labelOf(desk, n) + counted(v)).join("; ");
}

/** Rows of all checks: first the checks of the first run, then checks that only the second run has. */
function rowsOf(verdicts: readonly Verdict[]): Row[] {
  const rows = new Map<string, Row>();
  verdicts.forEach((v, n) =>
    v.checks.forEach((c) => rows.set(c.id, Object.assign(rows.get(c.id) ?? verdicts.map(() => undefined), { [n]: c }))),
  );
  return [...rows.values()];
}

/** For two runs, replaces the column of values by one column per run. Returns the number of columns of the table. */
function nameColumns({ ghost }: Desk): number {
  const head = element<HTMLTableElement>("checks").closest("table")!.tHead!.rows[0];
  if (ghost) {
    const columns = ghost.overlay.labels.map((label) => make("th", label));
    columns.forEach((c) => {
      c.scope = "col";
    });
    head.cells[2].replaceWith(...columns);
  }
  return head.cells.length;
}

/** Adds the rows group by group. Two or more checks that were not judged are folded into one row. */
function fill(desk: Desk, rows: Row[], columns: number): void {
  const body = element<HTMLTableSectionElement>("checks");
  const tried = new Set<string>();
  const folded: HTMLTableRowElement[] = [];
  const open = rows.filter((row) => worst(row) === "not judged");
  for (const group of new Set(rows.map((r) => first(r).group))) {
    const name = make("th", groups[group] ?? group);
    const title = make("tr.group", name);
    const own = rows.filter((row) => first(row).group === group);
    name.colSpan = columns;
    name.scope = "colgroup";
    body.append(title);
    if (own.every((row) => open.includes(row))) folded.push(title);
    for (const row of own) {
      const made = drawn(desk, row, tried);
      if (open.includes(row)) folded.push(made[0]);
      body.append(...made);
    }
  }
  if (open.length > 1) body.append(fold(open.map(first), folded, columns));
}

/** Text with the number of checks of a run for each status. */
function counted({ checks: all, counts }: Verdict): string {
  const { pass, warn, fail, "too close": close, "not judged": unknown } = counts;
  return [
    [fail, "failed"],
    [close, "too close"],
    [warn, warn === 1 ? "warning" : "warnings"],
    [pass - all.filter(noted).length, "passed"],
    [unknown, "not judged"],
  ]
    .filter(([k]) => k)
    .map(([k, word]) => `${k} ${word}`)
    .join(", ");
}

/** A row that shows and hides the checks that were not judged. */
function fold(open: Check[], rows: HTMLTableRowElement[], columns: number): HTMLTableRowElement {
  const button = link(`${plural(open.length, "check")} not judged`);
  const cell = make("td", button);
  const line = make("tr.fold", make("td.mark", icon(marks["not judged"])), cell);
  const set = (shown: boolean) => {
    rows.forEach((row) => {
      row.hidden = !shown;
    });
    button.setAttribute("aria-expanded", String(shown));
  };
  cell.colSpan = columns - 1;
  line.classList.add(given("not judged"));
  line.addEventListener("click", () => {
    element("checks").dispatchEvent(new Event("close"));
    set(rows[0].hidden);
  });
  set(false);
  return line;
}

const first = (row: Row): Check => row.find((c) => c)!;
const worst = (row: Row): Status =>
  (["fail", "too close", "warn", "pass", "not judged"] as const).find((s) => row.some((c) => c?.status === s)) ??
  "not judged";
const aloud = (check: Check): boolean => check.status !== "pass" && check.status !== "not judged";

/** Explanation of a check of one run, for an opened row. `label` is the name of the run, "" for a page of one run. */
function more(check: Check, label: string, called: string, text: string): HTMLElement[] {
  const { from, to, definition, source } = check;
  const where = [called, from !== null ? span(from, to ?? from) : ""].filter(Boolean).join(", ");
  return [
    ...(where ? [make("p", make("b", label + where))] : []),
    ...(aloud(check) ? [] : [make("p", label + sentence(text))]),
    ...(definition ? [make("p", sentence(definition))] : []),
    ...(source ? [make("p", sentence(`limit: ${source}`))] : []),
  ];
}

/** Advice for a failed check: the setting that helps, or a general remedy if no such setting is known. */
function remedy({ status, group, remedy: own, advice }: Check): string {
  const tried = (own || (group === "run" ? "" : advice)).replace(/^take /, "").replace(/[.]$/, "");
  return (status === "fail" || status === "too close") && tried ? `Try: ${tried}.` : "";
}

function limitOf(check: Check): string {
  const { limit, least, unit, source } = check;
  return limit === null
    ? noted(check)
      ? "a note"
      : check.status === "pass"
        ? "–"
        : "no limit"
    : (least ? "≥ " : "") + quantity(limit, unit) + (rests(source) ? "*" : "");
}

const labelOf = (desk: Desk, n: number): string => (desk.ghost ? `${desk.ghost.overlay.labels[n]}: ` : "");

/** Definitions and sources in an opened row; two runs share one definition. */
function explanation(desk: Desk, row: Row): Node[] {
  return row.flatMap((c, n) => {
    if (!c) return [];
    const called = c.worst === null ? "" : partName(desk.runs[n].recording.meta, c.part, c.worst);
    const source = row[0] && c.source === row[0].source ? "" : c.source;
    return more(n > 0 && row[0] ? { ...c, definition: "", source } : c, labelOf(desk, n), called, c.text);
  });
}

/**
 * Sentences under a check. `tried` contains the advice of earlier rows, which is not repeated. A check of an unstable
 * run has no advice, because the controller is the cause of its failure.
 */
function findings(c: Check, { unstable }: Verdict, label: string, tried: Set<string>): HTMLElement[] {
  const found: HTMLElement[] = [];
  const tip = unstable ? "" : remedy(c);
  const advice = label + tip;
  if (aloud(c)) found.push(make("p.why", label + sentence(c.text)));
  if (c.missing) found.push(make("p.short", `${label}Missing: ${c.missing}`));
  if (tip && !tried.has(advice)) {
    tried.add(advice);
    found.push(make("p.try", advice));
  }
  return found;
}

/** Two rows of the table for one check: a row of values, and below that a row with findings and explanation. */
function drawn(desk: Desk, row: Row, tried: Set<string>): HTMLTableRowElement[] {
  const status = worst(row);
  const open = link(first(row).title || first(row).id);
  const added = make("div.more", ...explanation(desk, row));
  const found = row.flatMap((c, n) =>
    c ? findings(c, desk.runs[n].recording.meta.verdict, labelOf(desk, n), tried) : [],
  );
  const head = summary(row, open, !!desk.ghost);
  const text = make("td", ...found, added);
  const detail = make("tr", make("td"), text);
  text.colSpan = head.cells.length - 1;
  const expand = (on: boolean) => {
    added.hidden = !on;
    detail.hidden = !on && !found.length;
    open.setAttribute("aria-expanded", String(on));
  };
  const at = row.findIndex((c) => c?.status === status);
  const run = desk.runs[Math.max(at, 0)];
  const place = row[at] ?? first(row);
  for (const one of [head, detail]) {
    one.className = given(status);
    one.classList.toggle("detail", one === detail);
    one.addEventListener("click", () => {
      const on = added.hidden;
      element("checks").dispatchEvent(new Event("close"));
      expand(on);
      show(run, place.part, place.worst, moment(run, place));
    });
  }
  expand(false);
  element("checks").addEventListener("close", () => expand(false));
  return [head, detail];
}

/** Row with mark, title, values and limits of a check. For two runs, each value has a mark. */
function summary(row: Row, title: HTMLElement, two: boolean): HTMLTableRowElement {
  const mark = (c: Check) =>
    noted(c) ? [make("span.sr", "a note")] : [icon(marks[c.status]), make("span.sr", words[c.status])];
  const value = (c: Check | undefined): HTMLElement => {
    const text = !c ? "–" : c.value === null ? "not judged" : quantity(c.value, c.unit);
    const cell = make("td.value", ...(two && c ? [...mark(c), " "] : []), text);
    if (two && c) cell.classList.add(given(c.status));
    return cell;
  };
  const limits = new Set(row.flatMap((c) => (c ? [limitOf(c)] : [])));
  const made = make(
    "tr",
    make("td.mark", ...(two ? [] : mark(first(row)))),
    make("td.what", title),
    ...row.map(value),
    make("td.limit", [...limits].join("; ")),
  );
  made.dataset.check = first(row).id;
  return made;
}
