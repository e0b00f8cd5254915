// Place of a part of the robot in the 3D picture: a joint, dock, body or foot.
import { Vector3 } from "three";
import type { Part } from "../data/format";
import { dockAt, jointAt } from "../data/places";
import type { View } from "./view";

/** Position of a part at the time shown; null if the robot has no such part. */
export function spot(view: View, part: Part, name: string | null): Vector3 | null {
  const { meta } = view;
  const dock = dockAt(meta, part, name);
  if (dock >= 0) return view.rings.centre(dock);
  const body = part === "body" || part === "foot" ? meta.bodies.findIndex((b) => b.name === name) : -1;
  if (body >= 0) return view.kinematics.positions[body].clone();
  const joint = jointAt(meta, part, name);
  return joint < 0 ? null : view.kinematics.pivots[joint].clone();
}

/** Points around a place that a view must contain. */
export const surroundings = (p: Vector3, r: number): Vector3[] =>
  [-r, r].flatMap((d) => [
    new Vector3(p.x + d, p.y, p.z),
    new Vector3(p.x, p.y + d, p.z),
    new Vector3(p.x, p.y, p.z + d),
  ]);
