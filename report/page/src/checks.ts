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

export function checks(desk: Desk): void {
  const { verdict } = desk.recording.meta, body = element<HTMLTableSectionElement>("checks");
  let group = "";
  for (const check of verdict.checks) {
    if (check.group !== group) {
      group = check.group;
      const head = make("th", groups[group] ?? group);
      head.colSpan = 4;
      head.scope = "colgroup";
      body.append(make("tr.group", head));
    }
    body.append(...rows(desk, check));
  }
  const chosen = verdict.checks.some((c) => c.limit !== null && rests(c.source));
  element("checks-note").textContent = chosen ? "* rests on a figure that is chosen, not a maker's; a row that is opened says which" : "";
  const { pass, warn, fail, "not judged": open } = verdict.counts;
  element("counts").textContent = [[pass, "passed"], [warn, warn === 1 ? "warning" : "warnings"], [fail, "failed"], [open, "not judged"]].filter(([n]) => n).map(([n, word]) => `${n} ${word}`).join(", ");
}

function rows(desk: Desk, check: Check): HTMLTableRowElement[] {
  const open = make("button.link", check.title || check.id), more = make("div.more"), from = check.from ?? null;
  open.type = "button";
  open.setAttribute("aria-expanded", "false");
  const where = [check.joint ?? "", from !== null ? span(from, check.to ?? from) : ""].filter(Boolean).join(", ");
  if (where) more.append(make("p", make("b", where)));
  const aloud = check.status === "warn" || check.status === "fail";
  if (!aloud) more.append(make("p", sentence(check.text)));
  if (check.definition) more.append(make("p", sentence(check.definition)));
  if (check.source) more.append(make("p", sentence(`limit: ${check.source}`)));
  more.hidden = true;
  const limit = check.limit === null ? "no limit" : (least.has(check.id) ? "≥ " : "") + quantity(check.limit, check.unit) + (rests(check.source) ? "*" : "");
  const head = make("tr", make("td.mark", icon(marks[check.status]), make("span.sr", words[check.status])), make("td.what", open),
    make("td.value", check.value === null ? "not judged" : quantity(check.value, check.unit)), make("td.limit", limit));
  const text = make("td", ...(aloud ? [make("p.why", sentence(check.text))] : []), ...(check.missing ? [make("p.short", `Missing: ${check.missing}`)] : []), more), detail = make("tr", make("td"), text);
  text.colSpan = 3;
  detail.hidden = !aloud && !check.missing;
  for (const one of [head, detail]) {
    one.className = `is-${check.status.replace(" ", "-")}`;
    one.classList.toggle("detail", one === detail);
    one.addEventListener("click", () => {
      const shown = !more.hidden, joint = desk.recording.meta.joints.findIndex((j) => j.name === check.joint);
      element("checks").dispatchEvent(new Event("close"));
      more.hidden = shown;
      detail.hidden = shown && !aloud && !check.missing;
      open.setAttribute("aria-expanded", String(!shown));
      if (joint >= 0) desk.choose(joint);
      if (from !== null) desk.goTo(from);
    });
  }
  element("checks").addEventListener("close", () => {
    more.hidden = true;
    detail.hidden = !aloud && !check.missing;
    open.setAttribute("aria-expanded", "false");
  });
  head.dataset.check = check.id;
  return [head, detail];
}

const sentence = (text: string): string => (text ? text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".") : "");
