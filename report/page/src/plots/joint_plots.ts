// Plots of the chosen joint over time: angle, set point and torque; command and current of its motor.
import type { Values } from "../data/channels";
import { element, leaveOut, make } from "../dom";
import type { Motor } from "../data/format";
import { keys, type Key } from "../keyline";
import { decimalsOf, fixed, number, percent } from "../data/numbers";
import type { Desk, Panel } from "../panel";
import type { Span } from "../data/recording";
import { curve, second, TimePlot, type Curve, type Level, type Tube } from "./timeplot";
import { limited } from "../data/motor";

type Cell = "angle" | "error" | "speed" | "torque" | "use";
/** Channel that must be recorded for each number under the plots. */
const SOURCE: Record<Cell, string> = {
  angle: "angle",
  error: "setpoint",
  speed: "speed",
  torque: "torque",
  use: "torque",
};

/** Signals of the chosen joint. Names that end in B are signals of the second run. */
type Signals = Record<
  "angle" | "measured" | "logged" | "setpoint" | "torque" | "loggedTorque" | "stopped" | "angleB" | "torqueB",
  Values | null
>;

export class JointPlots implements Panel {
  private plots: TimePlot[] = [];
  private readonly cells = new Map<Cell, HTMLElement>();

  constructor(private readonly desk: Desk) {
    const names: [Cell, string][] = [
      ["angle", "angle"],
      ["error", "error"],
      ["speed", "speed"],
      ["torque", "torque"],
      ...(desk.loads.limited ? [["use", "of its motor"] as [Cell, string]] : []),
    ];
    for (const [key, name] of names) {
      if (!desk.recording.any(SOURCE[key])) continue;
      const cell = make("dd");
      this.cells.set(key, cell);
      element("now").append(make("div", make("dt", name), cell));
    }
  }

  paint(): void {
    this.plots.forEach((p) => p.destroy());
    this.plots = [];
    const bands = this.saturated();
    if (this.has("angle")) this.motion(bands);
    else leaveOut(element("motion"), "the recording has no angles of the joints (trace.columns).");
    this.drive(bands);
    this.seek(this.desk.state.t);
  }

  choose(): void {
    this.paint();
  }
  zoom(): void {
    this.plots.forEach((p) => p.zoom());
  }

  seek(t: number): void {
    this.plots.forEach((p) => p.seek(t));
    const { recording, loads } = this.desk;
    const { joint } = this.desk.state;
    const now = (name: string) => recording.at(recording.channel(this.channel(name)), t);
    const motor = loads.motor(joint);
    const texts: Record<Cell, string> = {
      angle: `${fixed(now("angle"), 3)} rad`,
      error: `${fixed(now("setpoint") - now("angle"), 3)} rad`,
      speed: `${fixed(now("speed"), 2)} rad/s`,
      torque: `${fixed(now("torque"), decimalsOf(loads.peak, "N m"))} N m`,
      use: limited(motor) ? percent(Math.round(100 * loads.shareAt(joint, t)) / 100) : "no limit",
    };
    for (const [key, cell] of this.cells) cell.textContent = this.has(SOURCE[key]) ? texts[key] : "–";
  }

  // True if the quantity is recorded for the chosen joint.
  private has(name: string): boolean {
    return this.desk.recording.has(this.channel(name));
  }

  private channel(name: string): string {
    return `joint.${this.desk.state.joint}.${name}`;
  }

  // Draws angle and set point on the left axis, and torque on the right axis.
  private motion(bands: Span[]): void {
    const { desk } = this;
    const { ink, recording } = desk;
    const signals = this.signals();
    const stops = this.stops();
    const tubes = [...this.tube("angle", "left", ink.blue), ...this.tube("torque", "right", ink.vermillion)];
    this.plots.push(
      new TimePlot(element("motion"), desk, {
        label: `Angle, set point and torque of joint ${recording.meta.joints[desk.state.joint].name} over time`,
        bands,
        tubes,
        levels: [{ value: 0, axis: "left", colour: ink.line }, ...stops],
        left: { name: "angle (rad)", colour: ink.blue },
        ...(signals.torque ? { right: { name: "torque (N m)", colour: ink.vermillion } } : {}),
        curves: this.motionCurves(signals),
      }),
    );
    keys("motion-key", [
      ...this.motionKeys(signals),
      ["hatch", "--band", tubes.length ? "within three bands of the golden" : ""],
      ["band", "--band", bands.length ? "motor at its limit" : ""],
      ["dots", "--fail", stops.length ? "end of its range" : ""],
    ]);
  }

  private signals(): Signals {
    const { recording, ghost } = this.desk;
    const own = (quantity: string) => recording.find(this.channel(quantity));
    const other = (quantity: string) => ghost?.values(this.channel(quantity)) ?? null;
    const torque = own("torque");
    const pushed = torque && own("stop_torque");
    return {
      angle: own("angle"),
      measured: own("measured"),
      logged: own("logged_angle"),
      loggedTorque: own("logged_torque"),
      setpoint: own("setpoint"),
      torque,
      stopped: pushed?.some((v) => v !== 0) ? pushed : null,
      angleB: other("angle"),
      torqueB: torque && other("torque"),
    };
  }

  private motionCurves(signals: Signals): Curve[] {
    const { angle, measured, logged, setpoint, torque, loggedTorque, stopped, angleB, torqueB } = signals;
    const { ink, ghost } = this.desk;
    const label = ghost?.label ?? "";
    return [
      ...curve(logged, { label: "angle in the log", colour: ink.green, width: 3.5, axis: "left" }),
      ...curve(loggedTorque, { label: "torque in the log", colour: ink.purple, width: 2.5, axis: "right" }),
      ...curve(measured, { label: "measured angle", colour: ink.orange, width: 3.5, axis: "left" }),
      ...curve(angle, { label: "angle", colour: ink.blue, width: 2, axis: "left" }),
      ...curve(setpoint, { label: "set point", colour: ink.ink, dash: [2, 3], width: 1.3, axis: "left" }),
      ...curve(torque, { label: "torque", colour: ink.vermillion, width: 1.5, axis: "right" }),
      ...curve(stopped, { label: "torque of the stops", colour: ink.sky, width: 1.2, axis: "right" }),
      ...second(angleB, `angle, ${label}`, ink.blue, "left"),
      ...second(torqueB, `torque, ${label}`, ink.vermillion, "right"),
    ];
  }

  private motionKeys(signals: Signals): Key[] {
    const { measured, logged, setpoint, torque, loggedTorque, stopped, angleB, torqueB } = signals;
    const { ghost } = this.desk;
    const label = ghost?.label ?? "";
    return [
      ["dots", "--ink", setpoint ? "set point" : ""],
      ["", "--blue", "angle (left)"],
      ["", "--orange", measured ? "measured by its encoder (left)" : ""],
      ["", "--green", logged ? "angle in the log (left)" : ""],
      ["", "--vermillion", torque ? "torque (right)" : ""],
      ["", "--purple", loggedTorque ? "torque in the log (right)" : ""],
      ["", "--sky", stopped ? "torque of the hinge's stops (right)" : ""],
      ["dash", "--ink2", angleB || torqueB ? `${label}: dashed` : ""],
      ["", "", ghost && !angleB && !torqueB ? `${label} has no such joint` : ""],
    ];
  }

  // Tolerance around a signal that left its band; empty if the signal stayed in its band.
  private tube(quantity: string, axis: Tube["axis"], colour: string): Tube[] {
    const signal = this.channel(quantity);
    const around = this.desk.recording.find(signal);
    const stray = this.desk.ghost?.stray(signal);
    return around && stray ? [{ around, by: stray.tolerance, axis, colour }] : [];
  }

  // Draws the command of the motor (voltage or torque) and the motor's current.
  private drive(bands: Span[]): void {
    const { desk } = this;
    const { ink, recording } = desk;
    const motor = desk.loads.motor(desk.state.joint);
    const unit = motor?.unit ?? "V";
    const command = this.command(unit);
    const current = this.current();
    const host = element("drive");
    host.hidden = element("drive-key").hidden = !command;
    if (!command) return;
    const word = unit === "V" ? "voltage" : "torque asked for";
    const { name } = recording.meta.joints[desk.state.joint];
    this.plots.push(
      new TimePlot(host, desk, {
        label: `${unit === "V" ? "Voltage and current" : "Command"} of joint ${name} over time`,
        bands,
        levels: this.driveLevels(motor, !!current),
        left: { name: unit === "V" ? "voltage (V)" : "command (N m)", colour: ink.purple },
        ...(current ? { right: { name: "current (A)", colour: ink.green } } : {}),
        curves: this.driveCurves(command, word, current),
      }),
    );
    const limit = (value: number | null | undefined, u: string) => (value ? `, limit ±${number(value)} ${u}` : "");
    keys("drive-key", [
      ["", "--purple", `${word} (left)${limit(motor?.command, unit)}`],
      ["", "--green", current ? `current (right)${limit(motor?.current, "A")}` : ""],
    ]);
  }

  // Channel of the command; undefined if it is not recorded. An actuator with a command in N m has no voltage.
  private command(unit: Motor["unit"]): string | undefined {
    return (unit === "V" ? ["voltage", "voltage_command"] : ["voltage_command"]).find((name) => this.has(name));
  }

  // Current of the chosen joint; null if the current is not recorded, or if it is zero in all joints.
  private current(): Values | null {
    const { recording } = this.desk;
    const flows = recording.meta.joints.some((_, j) => recording.channel(`joint.${j}.current`).some((v) => v !== 0));
    return flows ? recording.find(this.channel("current")) : null;
  }

  private driveLevels(motor: Motor | null, withCurrent: boolean): Level[] {
    const { ink } = this.desk;
    const limits = (value: number | null | undefined, look: Omit<Level, "value">): Level[] =>
      value && Number.isFinite(value) ? [value, -value].map((v) => ({ value: v, ...look })) : [];
    return [
      { value: 0, axis: "left", colour: ink.line },
      ...limits(motor?.command, { axis: "left", colour: ink.purple, dash: [6, 4] }),
      ...(withCurrent ? limits(motor?.current, { axis: "right", colour: ink.green, dash: [2, 4] }) : []),
    ];
  }

  private driveCurves(command: string, word: string, current: Values | null): Curve[] {
    const { ink, recording, ghost } = this.desk;
    const other = (quantity: string) => ghost?.values(this.channel(quantity));
    const label = ghost?.label ?? "";
    return [
      { values: recording.channel(this.channel(command)), label: word, colour: ink.purple, axis: "left" },
      ...curve(current, { label: "current", colour: ink.green, axis: "right" }),
      ...second(other(command), `${word}, ${label}`, ink.purple, "left"),
      ...second(current && other("current"), `current, ${label}`, ink.green, "right"),
    ];
  }

  // Spans of time in which the motor is at a limit.
  private saturated(): Span[] {
    const { recording } = this.desk;
    const flags = recording.find(this.channel("saturation"));
    const out: Span[] = [];
    if (!flags) return out;
    let from = -1;
    for (let i = 0; i <= flags.length; i++) {
      const on = i < flags.length && flags[i] > 0;
      if (on && from < 0) from = i;
      if (!on && from >= 0) {
        out.push([recording.times[from], recording.times[Math.min(i, flags.length - 1)]]);
        from = -1;
      }
    }
    return out;
  }

  // Levels at the ends of the joint's range. Empty if the angle is never within 5 % of the range of an end.
  private stops(): Level[] {
    const { recording, state, ink } = this.desk;
    const { lo, hi } = recording.meta.joints[state.joint];
    if (lo === null || hi === null) return [];
    const room = 0.05 * (hi - lo);
    const near = recording.channel(this.channel("angle")).some((a) => a < lo + room || a > hi - room);
    return near ? [lo, hi].map((value) => ({ value, axis: "left", colour: ink.fail, dash: [2, 3] })) : [];
  }
}
