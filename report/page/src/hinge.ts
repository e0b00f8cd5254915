// Hinges of the robot: the axis of each joint, and the size of the disc that is drawn on it.
import { Quaternion, Vector3, type Matrix4 } from "three";
import type { Meta, Shape } from "./format";
import { matrix } from "./kinematics";
import { extents } from "./outline";

export interface Hinge {
  turn: Quaternion; // rotation from the y axis to the axis of the hinge
  size: Vector3; // radius, half length, radius of the disc, m
}

/** Unit vector of the axis of each joint, in the frame of the joint's pivot. */
export function axesOf({ joints, bodies }: Meta): Vector3[] {
  const axes = joints.map(() => new Vector3(0, 1, 0));
  for (const b of bodies) {
    if (b.joint >= 0) axes[b.joint] = new Vector3(...b.axis).normalize();
  }
  return axes;
}

/** Hinges on the axes. `unit` is the size of a typical body, m. */
export const hingesOf = (meta: Meta, axes: readonly Vector3[], unit: number): Hinge[] =>
  axes.map((axis, joint) => ({
    turn: new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), axis),
    size: size(meta, joint, axis, unit),
  }));

/** Size of the disc of a joint: slightly longer than the pieces around the pivot along the axis, and narrower. */
function size({ bodies, geometry }: Meta, joint: number, axis: Vector3, unit: number): Vector3 {
  const child = bodies.find((b) => b.joint === joint);
  if (!child) return fallback(unit);
  const widths = crossed(geometry[child.type] ?? [], matrix(child.post).invert(), axis, unit);
  if (child.parent >= 0) {
    widths.push(...crossed(geometry[bodies[child.parent].type] ?? [], matrix(child.pre), axis, unit));
  }
  const half = Math.max(0, ...widths.map((w) => w.half));
  const radius = Math.max(0.04 * unit, ...widths.map((w) => w.radius));
  return half === 0 ? fallback(unit) : new Vector3(radius, half + 0.023 * unit, radius);
}

const fallback = (unit: number): Vector3 => new Vector3(0.16, 0.52, 0.16).multiplyScalar(unit);

/** For each piece of a body that contains the pivot: half width along the axis, and largest radius of a disc, m. */
function crossed(
  shapes: readonly Shape[],
  fromPivot: Matrix4,
  axis: Vector3,
  unit: number,
): { half: number; radius: number }[] {
  const slack = 0.02 * unit;
  return shapes.flatMap((shape) => {
    const own = matrix(shape.pose).invert().multiply(fromPivot);
    const { centre, half: h } = extents(shape);
    const p = new Vector3().applyMatrix4(own).sub(centre);
    const a = axis.clone().transformDirection(own);
    if (Math.abs(p.x) > h.x + slack || Math.abs(p.y) > h.y + slack || Math.abs(p.z) > h.z + slack) return [];
    const across = [h.x, h.y, h.z].filter((_, k) => Math.abs([a.x, a.y, a.z][k]) < 0.5);
    return [
      {
        half: Math.abs(a.x) * h.x + Math.abs(a.y) * h.y + Math.abs(a.z) * h.z,
        radius: 0.55 * (shape.kind === "half_cylinder" ? shape.size[0] : Math.min(...across)),
      },
    ];
  });
}
