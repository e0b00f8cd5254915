// Table of the demand of joints that reach a limit of their motor, from a second run without motor limits
// (gaitlab report --demand).
import { element, link, make, rowHead, tableHead } from "../dom";
import { number } from "../data/numbers";
import type { Desk } from "../panel";

const few = 8;

export function demand(desk: Desk): void {
  const { runs, ghost } = desk;
  const verdicts = runs.map((r) => r.recording.meta.verdict);
  const joints = verdicts
    .flatMap((v, n) => (v.demand?.joints ?? []).map((d) => ({ ...d, n })))
    .sort((a, b) => (b.torque ?? 0) - (a.torque ?? 0));
  const rows = joints.slice(0, few).map(({ joint, voltage, current, torque, speed, n }) => {
    const name = link(ghost ? `${ghost.overlay.labels[n]} ${joint}` : joint, () =>
      runs[n].choose(runs[n].recording.meta.joints.findIndex((j) => j.name === joint)),
    );
    return make("tr", rowHead(name), ...[voltage, current, torque, speed].map((v) => make("td", number(v))));
  });
  const head = tableHead(["joint"], ["voltage", "V"], ["current", "A"], ["torque", "N m"], ["speed", "rad/s"]);
  element("demand").append(head, make("tbody", ...rows));
  element("demand-note").textContent = [
    joints.length > few ? `the ${few} of ${joints.length} joints with the largest torques` : "",
    ...new Set(verdicts.map((v) => v.demand?.doubt ?? "")),
  ]
    .filter(Boolean)
    .join("; ");
}
