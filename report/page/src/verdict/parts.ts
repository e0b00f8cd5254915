// Lists of the parts of a robot that was only assembled: modules, docks, hinges with their motors.
import { element, link, make, rowHead, tableHead } from "../dom";
import { joins } from "./docks";
import { fixed, number } from "../data/numbers";
import type { Desk } from "../panel";

const degrees = (a: number): string => (Math.abs(a) > 1e3 ? "free" : `${fixed((a * 180) / Math.PI, 0)}°`);

export function parts(desk: Desk): void {
  const { recording } = desk;
  const { modules, joints, docks } = recording.meta;
  const host = element("parts");
  const kinds = new Map<string, number>();
  for (const { type } of modules) kinds.set(type, (kinds.get(type) ?? 0) + 1);
  host.append(make("p.note", [...kinds].map(([type, n]) => `${n} × ${type}`).join(", ")));
  if (docks.length) host.append(make("h4", "Docks"), make("div.scroll", make("table.plain", ...joins(desk))));
  if (!joints.length) {
    host.append(make("p.empty", "The robot has no joints."));
    return;
  }
  const rows = joints.map((joint, j) => {
    const motor = desk.loads.motor(j);
    const made = make(
      "tr",
      rowHead(link(joint.name)),
      make("td", joint.lo === null || joint.hi === null ? "free" : `${degrees(joint.lo)} to ${degrees(joint.hi)}`),
      make("td", motor?.rest ? `${number(motor.rest)} N m` : "–"),
      make("td", motor?.no_load ? `${number(motor.no_load)} rad/s` : "–"),
    );
    made.addEventListener("click", () => desk.choose(j));
    return made;
  });
  const head = tableHead(["hinge"], ["range"], ["torque at rest"], ["speed without load"]);
  host.append(make("h4", "Hinges"), make("div.scroll", make("table.plain", head, make("tbody", ...rows))));
}
