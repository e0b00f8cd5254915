// Problems of a run, one after another: the failed checks, then the checks that are too close or warn, or else the
// tightest check. The line under the buttons of the 3D picture names the present one.
import { element, make } from "../dom";
import type { Check, Status } from "../data/format";
import { shareOfLimit } from "./facts";
import { failures, leading } from "./judgement";
import { inSentence, sentence } from "../data/numbers";
import type { Run } from "../panel";
import { show } from "./place";
import { moment, partName } from "../data/places";

const words: Record<Status, string> = {
  pass: "Tightest",
  warn: "Warning",
  fail: "Problem",
  "too close": "Too close",
  "not judged": "Not judged",
};

/** Checks of a run in the order of their urgency: first the check that the page opens at. */
function problemsOf(run: Run): Check[] {
  const { meta } = run.recording;
  if (meta.outcome === "not run") return [];
  const of = (status: Check["status"]) =>
    meta.verdict.checks
      .filter((c) => c.status === status && c.group !== "trust")
      .sort((a, b) => (a.margin ?? 1e300) - (b.margin ?? 1e300));
  const first = leading(run);
  const found = [...failures(meta).filter((c) => c.group !== "trust"), ...of("too close"), ...of("warn")];
  return first ? [first, ...found.filter((c) => c !== first)] : found;
}

export class Problems {
  private readonly all: Check[];
  private at = 0;

  /** `near` moves the camera to the part of a check. */
  constructor(
    private readonly run: Run,
    private readonly near: (check: Check) => void,
  ) {
    this.all = problemsOf(run);
    const host = element("problem");
    host.hidden = !this.all.length;
    if (!this.all.length) return;
    element("next-problem").addEventListener("click", () => this.next());
    this.say();
  }

  /** Goes to the next problem; after the last to the first. A single problem is shown again. */
  private next(): void {
    if (!this.all.length) return;
    this.at = (this.at + 1) % this.all.length;
    const check = this.all[this.at];
    show(this.run, check.part, check.worst, moment(this.run, check));
    this.near(check);
    this.say();
  }

  private say(): void {
    const { all, at } = this;
    const { status, id } = all[at];
    const { tightest } = this.run.recording.meta.verdict;
    const word = status === "pass" && id !== tightest ? "Hardest worked" : words[status];
    const count = all.length > 1 ? ` ${at + 1} of ${all.length}` : "";
    element("problem").dataset.status = status;
    const found = this.found(all[at]);
    element("problem-text").replaceChildren(make("b", `${word}${count}`), ` ${found}`);
    element("problem-text").title = found;
    element("next-problem").firstChild!.textContent = all.length > 1 ? "Next " : "Show ";
  }

  /** Finding of a check: its sentence, or for a check that passes its part, title and share of the limit. */
  private found(check: Check): string {
    const { status, text, part, worst, title, margin } = check;
    if (status !== "pass" && text) return sentence(text.split("; ")[0]);
    const share = margin === null ? "" : `: ${shareOfLimit(check, margin)}`;
    return worst === null || part === "none"
      ? `${title}${share}`
      : `${partName(this.run.recording.meta, part, worst)}, ${inSentence(title)}${share}`;
  }
}
