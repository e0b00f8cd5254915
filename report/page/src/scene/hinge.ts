// Hinges of the robot: the axis of each joint, and the size of the bodies around it.
import { Quaternion, Vector3 } from "three";
import type { Meta } from "../data/format";
import { matrix } from "../data/kinematics";
import { corners } from "./outline";

export interface Hinge {
  turn: Quaternion; // rotation from the y axis to the axis of the hinge
  half: number; // distance from the pivot, along the axis, at which both bodies of the hinge end, m
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
    half: Math.max(0, ...around(meta, joint).map((p) => Math.abs(p.dot(axis)))) || 0.5 * unit,
  }));

/** Corners of the two bodies of a joint, in the frame of its pivot at the angle 0. */
function around({ bodies, geometry }: Meta, joint: number): Vector3[] {
  const child = bodies.find((b) => b.joint === joint);
  if (!child) return [];
  const parent = bodies[child.parent];
  const of = (type: string) => (geometry[type] ?? []).flatMap(corners);
  const toParent = matrix(child.pre).invert();
  return [
    ...of(child.type).map((p) => p.applyMatrix4(matrix(child.post))),
    ...(parent ? of(parent.type).map((p) => p.applyMatrix4(toParent)) : []),
  ];
}
