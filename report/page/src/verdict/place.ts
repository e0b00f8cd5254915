// Place of a check on the page: the link that shows its part and its time.
import { link } from "../dom";
import type { Part } from "../data/format";
import type { Run } from "../panel";
import { jointAt, partName } from "../data/places";

/** Shows a part and a time: selects the joint of the part, names the part in the 3D picture, and sets the time. */
export function show(run: Run, part: Part, name: string | null, t: number | null): void {
  const joint = jointAt(run.recording.meta, part, name);
  if (joint >= 0) run.choose(joint);
  run.mark(part, name);
  if (t !== null) run.goTo(t);
}

/** Link with the name of a part, which shows the part and a time. */
export const place = (run: Run, part: Part, name: string, t: number | null): HTMLButtonElement =>
  link(partName(run.recording.meta, part, name), () => show(run, part, name, t));
