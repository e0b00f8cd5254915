// The failed checks in one line, in the order of the times at which they first fail: 0.78 s m4/active voltage → 6.15 s
// m5/active in the ground. A click on an entry shows its part and time.
import { link, make } from "../dom";
import type { Check, Meta } from "../data/format";
import { fixed } from "../data/numbers";
import type { Run } from "../panel";
import { show } from "./place";
import { everyPeriod, firstMoment, partName } from "../data/places";

/** Words for events by check; for others the words of the id. */
const words: Record<string, string> = {
  upright: "turns over",
  stall: "stalls",
  in_ground: "in the ground",
  collision: "in another body",
  brownout: "supply too low",
  battery: "supply current",
};

/** Checks of the events, in their order. Everything follows from an unstable controller, which is not an event. */
export const happened = ({ verdict: { events, checks, unstable } }: Meta): Check[] =>
  unstable ? [] : (events ?? []).flatMap(({ check }) => checks.find((c) => c.id === check) ?? []);

/** Fills a list with the events of a run; hides it if there are none. */
export function events(list: HTMLElement, run: Run): void {
  const entries = happened(run.recording.meta).map((check) => make("li", entry(run, check)));
  list.hidden = !entries.length;
  list.append(...entries);
  if (entries.length) fit(list, entries);
}

function entry(run: Run, check: Check): HTMLElement {
  const { id, part, first, first_part } = check;
  const { meta, end } = run.recording;
  const name = first_part ?? check.worst;
  const what =
    id === "fall"
      ? `falls${check.to !== null && check.to > end - meta.period ? " and stays down" : ""}`
      : (words[id] ?? id.replace(/^dock_/, "").replaceAll("_", " "));
  const how = everyPeriod(run, check) ? ", every period" : "";
  const made = link("", () => show(run, part, name, firstMoment(run, check)));
  const at = make("b", `${fixed(first ?? 0, 2)} s`);
  made.append(at, ` ${name === null ? "" : `${partName(meta, part, name)} `}${what}${how}`);
  return made;
}

/** Hides the last entries if the list is higher than the style sheet permits, behind a button that shows them. */
function fit(list: HTMLElement, entries: HTMLElement[]): void {
  let all = false;
  const button = link("", () => {
    all = true;
    lay();
    entries[shown].querySelector("button")!.focus();
  });
  const more = make("li.more", button);
  let shown = entries.length;
  const set = (count: number) => {
    entries.forEach((one, k) => {
      one.hidden = k >= count;
    });
    more.hidden = count === entries.length;
    button.textContent = `and ${entries.length - count} more`;
  };
  const lay = () => {
    list.classList.toggle("all", all);
    set(entries.length);
    if (all) return;
    const bottom = () => (more.hidden ? entries[shown - 1] : more).getBoundingClientRect().bottom;
    for (shown = entries.length; shown > 1 && bottom() > list.getBoundingClientRect().bottom + 1; ) set(--shown);
  };
  list.append(more);
  new ResizeObserver(lay).observe(list);
}
