// Plot of torque over speed within the envelope of the chosen joint's motor. Dots are states of all joints with this
// motor, a line is the last period of the chosen joint, and a ring is the state of the chosen joint at the time shown.
import { Board, clipped, font, frame, line, trace, type Box, type Pen, type Scale } from "./board";
import type { Values } from "../data/channels";
import { element, leaveOut } from "../dom";
import type { Motor } from "../data/format";
import { keys } from "../keyline";
import { largest } from "../data/loads";
import { least, limited, most } from "../data/motor";
import { number } from "../data/numbers";
import type { Desk, Panel } from "../panel";

/** Speed and torque of a joint of the second run. The plot shows the rows from `from` on. */
interface Second {
  speed: Values;
  torque: Values;
  motor: Motor | null;
  from: number;
}

export class Envelope implements Panel {
  private readonly board: Board | null = null;
  private readonly dot = element("envelope-dot");
  private scale: Scale | null = null;

  constructor(private readonly desk: Desk) {
    const host = element("envelope");
    const { recording } = desk;
    if (!recording.any("torque") || !recording.any("speed")) {
      leaveOut(
        host,
        recording.meta.motors.length
          ? "the recording has no torques and speeds of the joints (trace.columns)."
          : "the joints have no motors.",
      );
    } else {
      this.board = new Board(host, "Torque over speed, within the envelope of the motor", (pen, width, height) =>
        this.draw(pen, width, height),
      );
    }
  }

  paint(): void {
    if (!this.board) return;
    const motor = this.desk.loads.motor(this.desk.state.joint);
    keys("envelope-key", [
      ["", "--blue", this.desk.recording.meta.cycle ? "chosen joint, last period" : "chosen joint"],
      ["cloud", "--cloud", this.driven && this.peers.length > 1 ? "all joints with this motor" : ""],
      ["hatch", "--hatch", limited(motor) ? "out of reach" : ""],
      ["dash", "--purple", this.second() ? `${this.desk.ghost!.label}, its last period` : ""],
    ]);
    this.board.paint();
  }

  choose(): void {
    this.paint();
  }

  seek(t: number): void {
    if (!this.scale) return;
    const { recording } = this.desk;
    const { joint } = this.desk.state;
    const now = (name: string) => recording.at(recording.channel(`joint.${joint}.${name}`), t);
    this.dot.style.transform = `translate(${this.scale.X(now("speed"))}px,${this.scale.Y(now("torque"))}px)`;
  }

  // Signals of the joint of the same name in the second run; null if there is none.
  private second(): Second | null {
    const { ghost, state } = this.desk;
    const j = ghost?.number("joint", state.joint) ?? -1;
    if (!ghost || j < 0) return null;
    const { recording, loads } = ghost;
    const speed = recording.find(`joint.${j}.speed`);
    const torque = recording.find(`joint.${j}.torque`);
    return speed && torque && { speed, torque, motor: loads.motor(j), from: recording.lastPeriod };
  }

  private get driven(): boolean {
    return this.desk.recording.has(`joint.${this.desk.state.joint}.torque`);
  }

  private get peers(): number[] {
    const { joints } = this.desk.recording.meta;
    const mine = joints[this.desk.state.joint].motor;
    return joints.flatMap((j, i) => (j.motor === mine ? [i] : []));
  }

  private draw(pen: Pen, width: number, height: number): void {
    const { desk, peers } = this;
    const motor = desk.loads.motor(desk.state.joint);
    const second = this.second();
    const [w, T] = this.reach(peers, second);
    const box: Box = { left: 52, right: width - 14, top: 10, bottom: height - 44 };
    const steady = continuous(motor);
    this.scale = frame(pen, desk.ink, box, [-w, w], [-T, T], { x: "joint speed (rad/s)", y: "torque (N m)" });
    clipped(pen, box, () => {
      const speeds = Array.from({ length: 241 }, (_, i) => -w + (2 * w * i) / 240);
      this.envelopes(pen, box, motor, second?.motor ?? null, speeds);
      this.zeros(pen, box);
      if (steady) this.steady(pen, box, steady);
      this.points(pen, peers);
      if (second) this.pointsOfSecond(pen, second);
    });
    this.write(pen, box, motor, steady);
    this.seek(desk.state.t);
  }

  private envelopes(pen: Pen, box: Box, motor: Motor | null, their: Motor | null, speeds: number[]): void {
    if (limited(motor)) this.bounds(pen, box, motor, speeds);
    if (limited(their) && their !== motor && JSON.stringify(their) !== JSON.stringify(motor)) {
      this.boundsOfSecond(pen, their, speeds);
    }
  }

  private zeros(pen: Pen, box: Box): void {
    const { X, Y } = this.scale!;
    pen.strokeStyle = this.desk.ink.line;
    pen.lineWidth = 1;
    line(pen, box.left, Y(0), box.right, Y(0));
    line(pen, X(0), box.top, X(0), box.bottom);
  }

  private steady(pen: Pen, box: Box, torque: number): void {
    const { Y } = this.scale!;
    pen.setLineDash([5, 4]);
    pen.strokeStyle = this.desk.ink.orange;
    pen.lineWidth = 1.3;
    for (const sign of [1, -1]) line(pen, box.left, Y(sign * torque), box.right, Y(sign * torque));
    pen.setLineDash([]);
  }

  // Largest speed and torque on the axes, rad/s and N m.
  private reach(peers: number[], second: Second | null): [number, number] {
    const { loads, recording, state } = this.desk;
    const from = recording.judged;
    const motor = loads.motor(state.joint);
    const their = second?.motor ?? null;
    const most = (quantity: string) =>
      Math.max(...peers.map((j) => largest(recording.channel(`joint.${j}.${quantity}`), from)), 1e-6);
    const torque = limited(motor) ? Math.max(...motor.most, ...motor.least.map((v) => -v)) : 0;
    const theirTorque = limited(their) ? Math.max(...their.most) : 0;
    const theirs = second ? [largest(second.speed, second.from), largest(second.torque, second.from)] : [0, 0];
    return [
      1.08 * Math.max(most("speed"), motor?.no_load ?? 0, theirs[0], their?.no_load ?? 0),
      1.15 * Math.max(most("torque"), torque, theirs[1], theirTorque),
    ];
  }

  // Fills the region outside the envelope, and draws its boundary.
  private bounds(pen: Pen, box: Box, motor: Motor, speeds: number[]): void {
    const { ink } = this.desk;
    const { X, Y } = this.scale!;
    const inside = new Path2D();
    const outside = new Path2D();
    for (const v of speeds) inside.lineTo(X(v), Y(most(motor, v)));
    for (const v of [...speeds].reverse()) inside.lineTo(X(v), Y(least(motor, v)));
    inside.closePath();
    outside.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    outside.addPath(inside);
    pen.fillStyle = ink.hatch;
    pen.fill(outside, "evenodd");
    pen.strokeStyle = ink.vermillion;
    pen.lineWidth = 1.6;
    pen.stroke(inside);
  }

  private boundsOfSecond(pen: Pen, motor: Motor, speeds: number[]): void {
    const { X, Y } = this.scale!;
    pen.setLineDash([7, 4]);
    pen.strokeStyle = this.desk.ink.vermillion;
    pen.lineWidth = 1.3;
    for (const bound of [most, least]) {
      pen.beginPath();
      for (const v of speeds) pen.lineTo(X(v), Y(bound(motor, v)));
      pen.stroke();
    }
    pen.setLineDash([]);
  }

  // Draws dots for all joints with this motor, about 40 000 at most, and then the line of the chosen joint.
  private points(pen: Pen, peers: number[]): void {
    const { recording, ink, state } = this.desk;
    const { rows, judged: from } = recording;
    const { X, Y } = this.scale!;
    const step = Math.max(1, Math.floor(((rows - from) * peers.length) / 40000));
    const curve = (j: number) => [recording.channel(`joint.${j}.speed`), recording.channel(`joint.${j}.torque`)];
    pen.fillStyle = ink.cloud;
    for (const j of peers) {
      const [v, u] = curve(j);
      for (let i = from; i < rows; i += step) pen.fillRect(X(v[i]) - 0.75, Y(u[i]) - 0.75, 1.5, 1.5);
    }
    const [v, u] = curve(state.joint);
    pen.strokeStyle = ink.blue;
    pen.lineWidth = 1.8;
    pen.lineJoin = "round";
    trace(pen, this.scale!, v, u, recording.lastPeriod);
  }

  private pointsOfSecond(pen: Pen, { speed, torque, from }: Second): void {
    pen.setLineDash([7, 4]);
    pen.strokeStyle = this.desk.ink.purple;
    pen.lineWidth = 1.5;
    trace(pen, this.scale!, speed, torque, from);
    pen.setLineDash([]);
  }

  private write(pen: Pen, box: Box, motor: Motor | null, steady: number | null): void {
    const { ink } = this.desk;
    const { Y } = this.scale!;
    pen.font = font(11);
    pen.textBaseline = "bottom";
    pen.textAlign = "left";
    if (!limited(motor)) {
      const unknown = this.driven ? "no limit of this actuator is known" : "no torque of this joint is recorded";
      pen.fillStyle = ink.muted;
      pen.textBaseline = "top";
      pen.fillText(unknown, box.left + 8, box.top + 6);
      return;
    }
    this.writeLimits(pen, box, motor);
    if (steady) {
      pen.textAlign = "left";
      pen.fillStyle = ink.orange;
      pen.fillText(`continuous ${number(motor.continuous)} A`, box.left + 8, Y(steady) - 3);
    }
  }

  // Writes the current limit or the torque at rest at the left, and the largest voltage near the no-load speed.
  private writeLimits(pen: Pen, box: Box, motor: Motor): void {
    const { X, Y } = this.scale!;
    const top = most(motor, -(motor.no_load ?? 0) || 0);
    const label =
      motor.current && Math.abs(most(motor, 0) - top) < 0.01 * top
        ? `current limit ${number(motor.current)} A`
        : motor.rest
          ? `at rest ${number(motor.rest)} N m`
          : "";
    pen.fillStyle = this.desk.ink.vermillion;
    if (Y(top) > box.top + 14) pen.fillText(label, box.left + 8, Y(top) - 3);
    if (motor.unit === "V" && motor.command && motor.no_load) {
      const w = 0.93 * motor.no_load;
      const y = Y(Math.max(most(motor, w), 0));
      pen.textAlign = "right";
      pen.fillText(
        `${number(motor.command)} V`,
        Math.min(X(motor.no_load), box.right - 6) - 2,
        Math.min(y - 26, box.bottom - 6),
      );
    }
  }
}

/** Torque at the continuous current, N m; null if the motor has no such limit below its largest current. */
function continuous(motor: Motor | null): number | null {
  return motor?.continuous && motor.current && motor.rest && motor.continuous < motor.current
    ? motor.rest * Math.min(1, motor.continuous / motor.current)
    : null;
}
