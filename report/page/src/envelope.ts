// Torque over speed in what the chosen joint's motor can give: all joints with such a motor as a cloud, the chosen one's last period
// as a line, a ring where it is now.
import { Board, font, frame, line, type Box, type Pen, type Scale } from "./board";
import type { Values } from "./channels";
import { element, leaveOut } from "./dom";
import type { Motor } from "./format";
import { keys } from "./keyline";
import { largest } from "./loads";
import { least, limited, most } from "./motor";
import { number } from "./numbers";
import type { Desk, Panel } from "./panel";

export class Envelope implements Panel {
  private readonly board: Board | null = null;
  private readonly dot = element("envelope-dot");
  private scale: Scale | null = null;

  constructor(private readonly desk: Desk) {
    const host = element("envelope"), { recording } = desk;
    if (!recording.any("torque") || !recording.any("speed")) leaveOut(host, recording.meta.motors.length ? "the recording has no torques and speeds of the joints (trace.columns)." : "the joints have no motors.");
    else this.board = new Board(host, "Torque over speed, in what the motor can give", (pen, width, height) => this.draw(pen, width, height));
  }

  paint(): void {
    if (!this.board) return;
    const motor = this.desk.loads.motor(this.desk.state.joint);
    keys("envelope-key", [["", "--blue", this.desk.recording.meta.cycle ? "chosen joint, last period" : "chosen joint"], ["cloud", "--cloud", this.driven && this.peers.length > 1 ? "all joints with this motor" : ""],
      ["hatch", "--hatch", limited(motor) ? "out of reach" : ""], ["dash", "--purple", this.second() ? `${this.desk.ghost!.label}, its last period` : ""]]);
    this.board.paint();
  }

  choose(): void { this.paint(); }

  seek(t: number): void {
    if (!this.scale) return;
    const { recording, state: { joint } } = this.desk, now = (name: string) => recording.at(recording.channel(`joint.${joint}.${name}`), t);
    this.dot.style.transform = `translate(${this.scale.X(now("speed"))}px,${this.scale.Y(now("torque"))}px)`;
  }

  // The second run's joint of the same name.
  private second(): { speed: Values; torque: Values; motor: Motor | null; from: number } | null {
    const { ghost, state } = this.desk, j = ghost?.number("joint", state.joint) ?? -1;
    if (!ghost || j < 0) return null;
    const { recording, loads } = ghost, speed = recording.find(`joint.${j}.speed`), torque = recording.find(`joint.${j}.torque`), { cycle } = recording.meta;
    return speed && torque && { speed, torque, motor: loads.motor(j), from: cycle ? Math.max(recording.judged, recording.row(recording.end - cycle.period)) : recording.judged };
  }

  private get driven(): boolean { return this.desk.recording.has(`joint.${this.desk.state.joint}.torque`); }

  private get peers(): number[] {
    const { joints } = this.desk.recording.meta, mine = joints[this.desk.state.joint].motor;
    return joints.flatMap((j, i) => (j.motor === mine ? [i] : []));
  }

  private draw(pen: Pen, width: number, height: number): void {
    const { desk } = this, { recording, ink, state: { joint } } = desk, { meta } = recording, from = recording.judged, motor = desk.loads.motor(joint), peers = this.peers;
    const speed = (j: number) => recording.channel(`joint.${j}.speed`), torque = (j: number) => recording.channel(`joint.${j}.torque`);
    const reach = limited(motor) ? Math.max(...motor.most, ...motor.least.map((v) => -v)) : 0;
    const fastest = Math.max(...peers.map((j) => largest(speed(j), from)), 1e-6), hardest = Math.max(...peers.map((j) => largest(torque(j), from)), 1e-6);
    const second = this.second(), their = second?.motor ?? null, beyond = limited(their) ? Math.max(...their.most) : 0;
    const w = 1.08 * Math.max(fastest, motor?.no_load ?? 0, second ? largest(second.speed, second.from) : 0, their?.no_load ?? 0), T = 1.15 * Math.max(hardest, reach, second ? largest(second.torque, second.from) : 0, beyond);
    const box: Box = { left: 52, right: width - 14, top: 10, bottom: height - 44 };
    const { X, Y } = (this.scale = frame(pen, ink, box, [-w, w], [-T, T], { x: "joint speed (rad/s)", y: "torque (N m)" }));
    pen.save();
    pen.beginPath();
    pen.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    pen.clip();
    if (limited(motor)) {
      const n = 240, at = Array.from({ length: n + 1 }, (_, i) => -w + 2 * w * i / n), inside = new Path2D(), outside = new Path2D();
      [...at.map((v) => [v, most(motor, v)]), ...at.reverse().map((v) => [v, least(motor, v)])].forEach(([v, u], i) => (i ? inside.lineTo(X(v), Y(u)) : inside.moveTo(X(v), Y(u))));
      inside.closePath();
      outside.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
      outside.addPath(inside);
      pen.fillStyle = ink.hatch;
      pen.fill(outside, "evenodd");
      pen.strokeStyle = ink.vermillion;
      pen.lineWidth = 1.6;
      pen.stroke(inside);
    }
    if (limited(their) && their !== motor && JSON.stringify(their) !== JSON.stringify(motor)) {
      pen.setLineDash([7, 4]);
      pen.strokeStyle = ink.vermillion;
      pen.lineWidth = 1.3;
      for (const bound of [most, least]) {
        pen.beginPath();
        for (let i = 0; i <= 240; i++) pen.lineTo(X(-w + 2 * w * i / 240), Y(bound(their, -w + 2 * w * i / 240)));
        pen.stroke();
      }
      pen.setLineDash([]);
    }
    pen.strokeStyle = ink.line;
    pen.lineWidth = 1;
    line(pen, box.left, Y(0), box.right, Y(0));
    line(pen, X(0), box.top, X(0), box.bottom);
    const steady = motor?.continuous && motor.current && motor.rest && motor.continuous < motor.current ? motor.rest * Math.min(1, motor.continuous / motor.current) : null;
    if (steady) {
      pen.setLineDash([5, 4]);
      pen.strokeStyle = ink.orange;
      pen.lineWidth = 1.3;
      for (const sign of [1, -1]) line(pen, box.left, Y(sign * steady), box.right, Y(sign * steady));
      pen.setLineDash([]);
    }
    // The cloud, thinned to 40 000 points; then the line.
    pen.fillStyle = ink.cloud;
    const rows = recording.rows, step = Math.max(1, Math.floor((rows - from) * peers.length / 40000));
    for (const j of peers) {
      const v = speed(j), u = torque(j);
      for (let i = from; i < rows; i += step) pen.fillRect(X(v[i]) - 0.75, Y(u[i]) - 0.75, 1.5, 1.5);
    }
    const first = meta.cycle ? Math.max(from, recording.row(recording.end - meta.cycle.period)) : from, v = speed(joint), u = torque(joint);
    pen.strokeStyle = ink.blue;
    pen.lineWidth = 1.8;
    pen.lineJoin = "round";
    pen.beginPath();
    for (let i = first; i < rows; i++) pen.lineTo(X(v[i]), Y(u[i]));
    pen.stroke();
    if (second) {
      pen.setLineDash([7, 4]);
      pen.strokeStyle = ink.purple;
      pen.lineWidth = 1.5;
      pen.beginPath();
      for (let i = second.from; i < second.speed.length; i++) pen.lineTo(X(second.speed[i]), Y(second.torque[i]));
      pen.stroke();
      pen.setLineDash([]);
    }
    pen.restore();
    this.write(pen, box, steady);
    this.seek(desk.state.t);
  }

  private write(pen: Pen, box: Box, steady: number | null): void {
    const { ink, loads, state: { joint } } = this.desk, motor = loads.motor(joint), { X, Y } = this.scale!;
    pen.font = font(11);
    pen.textBaseline = "bottom";
    pen.textAlign = "left";
    if (!limited(motor)) {
      pen.fillStyle = ink.muted;
      pen.textBaseline = "top";
      pen.fillText(this.driven ? "no limit of this actuator is known" : "no torque of this joint is recorded", box.left + 8, box.top + 6);
      return;
    }
    const top = most(motor, -(motor.no_load ?? 0) || 0), label = motor.current && Math.abs(most(motor, 0) - top) < 0.01 * top ? `current limit ${number(motor.current)} A` : motor.rest ? `at rest ${number(motor.rest)} N m` : "";
    pen.fillStyle = ink.vermillion;
    if (Y(top) > box.top + 14) pen.fillText(label, box.left + 8, Y(top) - 3);
    if (motor.unit === "V" && motor.command && motor.no_load) {
      const w = 0.93 * motor.no_load, y = Y(Math.max(most(motor, w), 0));
      pen.textAlign = "right";
      pen.fillText(`${number(motor.command)} V`, Math.min(X(motor.no_load), box.right - 6) - 2, Math.min(y - 26, box.bottom - 6));
    }
    if (steady) {
      pen.textAlign = "left";
      pen.fillStyle = ink.orange;
      pen.fillText(`continuous ${number(motor.continuous)} A`, box.left + 8, Y(steady) - 3);
    }
  }
}
