// Forward kinematics: poses of the bodies at a time, from the pose of the base and the joint angles.
import { Matrix4, Quaternion, Vector3 } from "three";
import type { Values } from "./channels";
import type { Pose } from "./format";
import type { Recording } from "./recording";

export const position = (pose: Pose): Vector3 => new Vector3(pose[0], pose[1], pose[2]);
export const rotation = (pose: Pose): Quaternion => new Quaternion(pose[4], pose[5], pose[6], pose[3]);
export const matrix = (pose: Pose): Matrix4 =>
  new Matrix4().compose(position(pose), rotation(pose), new Vector3(1, 1, 1));

interface Link {
  parent: number;
  joint: number;
  axis: Vector3;
  pre: Vector3;
  preTurn: Quaternion;
  post: Vector3;
  postTurn: Quaternion;
}

export class Kinematics {
  readonly positions: Vector3[];
  readonly turns: Quaternion[];
  /** World position of the pivot of each joint, and orientation of the frame in which the joint's axis is given. */
  readonly pivots: Vector3[];
  readonly pivotTurns: Quaternion[];
  private readonly links: Link[];
  private readonly base: Values[];
  private readonly angles: Values[];

  constructor(private readonly recording: Recording) {
    const { bodies, joints } = recording.meta;
    const upright = new Float32Array(recording.rows).fill(1);
    this.base = ["x", "y", "z", "qw", "qx", "qy", "qz"].map(
      (c) => recording.find(`base.${c}`) ?? (c === "qw" ? upright : recording.channel("")),
    );
    this.angles = joints.map((_, j) => recording.channel(`joint.${j}.angle`));
    this.links = bodies.map((b) => ({
      parent: b.parent,
      joint: b.joint,
      axis: new Vector3(...b.axis),
      pre: position(b.pre),
      preTurn: rotation(b.pre),
      post: position(b.post),
      postTurn: rotation(b.post),
    }));
    this.positions = bodies.map(() => new Vector3());
    this.turns = bodies.map(() => new Quaternion());
    this.pivots = joints.map(() => new Vector3());
    this.pivotTurns = joints.map(() => new Quaternion());
  }

  set(t: number): void {
    const { recording } = this;
    const step = new Vector3();
    const turn = new Quaternion();
    const [x, y, z, qw, qx, qy, qz] = this.base.map((values) => recording.at(values, t));
    const base = new Vector3(x, y, z);
    const baseTurn = new Quaternion(qx, qy, qz, qw).normalize();
    this.links.forEach((link, i) => {
      const p = this.positions[i];
      const q = this.turns[i];
      p.copy(link.parent < 0 ? base : this.positions[link.parent]);
      q.copy(link.parent < 0 ? baseTurn : this.turns[link.parent]);
      p.add(step.copy(link.pre).applyQuaternion(q));
      q.multiply(link.preTurn);
      if (link.joint >= 0) {
        this.pivots[link.joint].copy(p);
        this.pivotTurns[link.joint].copy(q);
        q.multiply(turn.setFromAxisAngle(link.axis, recording.at(this.angles[link.joint], t)));
      }
      p.add(step.copy(link.post).applyQuaternion(q));
      q.multiply(link.postTurn);
    });
  }
}
