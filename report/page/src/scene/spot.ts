// Place of a part of the robot in the 3D picture: a joint, dock, body or foot.
import { Vector3 } from "three";
import type { Meta, Part } from "../data/format";
import type { Kinematics } from "../data/kinematics";
import { dockAt, jointAt } from "../data/places";
import type { Rings } from "./rings";

/** A robot with its poses and rings at the time shown. */
interface Posed {
  meta: Meta;
  kinematics: Kinematics;
  rings: Rings;
}

/** Position of a part at the time shown; null if the robot has no such part. */
export function spot({ meta, kinematics, rings }: Posed, part: Part, name: string | null): Vector3 | null {
  const dock = dockAt(meta, part, name);
  if (dock >= 0) return rings.centre(dock);
  const body = part === "body" || part === "foot" ? meta.bodies.findIndex((b) => b.name === name) : -1;
  if (body >= 0) return kinematics.positions[body].clone();
  const joint = jointAt(meta, part, name);
  return joint < 0 ? null : kinematics.pivots[joint].clone();
}

/** Points around a place that a view must contain. */
export const surroundings = (p: Vector3, r: number): Vector3[] =>
  [-r, r].flatMap((d) => [
    new Vector3(p.x + d, p.y, p.z),
    new Vector3(p.x, p.y + d, p.z),
    new Vector3(p.x, p.y, p.z + d),
  ]);
