// The chosen joint over time: angle, set point and torque; what its motor is asked for and draws.
import { element, leaveOut, make } from "./dom";
import { keys } from "./keyline";
import { decimalsOf, fixed, number, percent } from "./numbers";
import type { Desk, Panel, Span } from "./panel";
import { second, TimePlot, type Level, type Tube } from "./timeplot";
import { limited } from "./motor";

type Cell = "angle" | "error" | "speed" | "torque" | "use";
const SOURCE: Record<Cell, string> = { angle: "angle", error: "setpoint", speed: "speed", torque: "torque", use: "torque" };

export class JointPlots implements Panel {
  private plots: TimePlot[] = [];
  private readonly cells = new Map<Cell, HTMLElement>();

  constructor(private readonly desk: Desk) {
    const names: [Cell, string][] = [["angle", "angle"], ["error", "error"], ["speed", "speed"], ["torque", "torque"], ...(desk.loads.limited ? [["use", "of its motor"] as [Cell, string]] : [])];
    for (const [key, name] of names) {
      if (!desk.recording.any(SOURCE[key])) continue;
      const cell = make("dd");
      this.cells.set(key, cell);
      element("now").append(make("div", make("dt", name), cell));
    }
  }

  paint(): void {
    const { desk } = this, { ink, state: { joint } } = desk, values = (name: string) => desk.recording.channel(`joint.${joint}.${name}`);
    this.plots.forEach((p) => p.destroy());
    this.plots = [];
    const { recording } = desk, zero: Level = { value: 0, axis: "left", colour: ink.line }, bands = this.saturated(), name = desk.recording.meta.joints[joint].name;
    if (this.has("angle")) {
      const torque = this.has("torque"), setpoint = this.has("setpoint"), range = desk.recording.meta.joints[joint], reached = this.nearStops();
      const stops: Level[] = reached ? [range.lo ?? 0, range.hi ?? 0].map((value) => ({ value, axis: "left", colour: ink.fail, dash: [2, 3] })) : [];
      const other = (quantity: string) => desk.ghost?.values(`joint.${joint}.${quantity}`) ?? null, angleB = other("angle"), torqueB = torque ? other("torque") : null, label = desk.ghost?.label ?? "";
      const tube = (quantity: string, axis: Tube["axis"], colour: string): Tube[] => {
        const stray = desk.ghost?.stray(`joint.${joint}.${quantity}`);
        return stray ? [{ around: values(quantity), by: stray.tolerance, axis, colour }] : [];
      };
      const tubes = [...tube("angle", "left", ink.blue), ...(torque ? tube("torque", "right", ink.vermillion) : [])];
      const pushed = recording.find(`joint.${joint}.stop_torque`), stopped = pushed?.some((v) => v !== 0) ? pushed : null;
      this.plots.push(new TimePlot(element("motion"), desk, {
        label: `Angle, set point and torque of joint ${name} over time`, bands, tubes, levels: [zero, ...stops],
        left: { name: "angle (rad)", colour: ink.blue }, ...(torque ? { right: { name: "torque (N m)", colour: ink.vermillion } } : {}),
        curves: [
          { values: values("angle"), label: "angle", colour: ink.blue, width: 2, axis: "left" },
          ...(setpoint ? [{ values: values("setpoint"), label: "set point", colour: ink.ink, dash: [2, 3], width: 1.3, axis: "left" as const }] : []),
          ...(torque ? [{ values: values("torque"), label: "torque", colour: ink.vermillion, width: 1.5, axis: "right" as const }] : []),
          ...(torque && stopped ? [{ values: stopped, label: "torque of the stops", colour: ink.green, width: 1.2, axis: "right" as const }] : []),
          ...(angleB ? [second(angleB, `angle, ${label}`, ink.blue, "left")] : []),
          ...(torqueB ? [second(torqueB, `torque, ${label}`, ink.vermillion, "right")] : []),
        ],
      }));
      keys("motion-key", [["dash", "--ink", setpoint ? "set point" : ""], ["", "--blue", "angle (left)"], ["", "--vermillion", torque ? "torque (right)" : ""],
        ["", "--green", torque && stopped ? "torque of the hinge's stops (right)" : ""], ["dash", "--ink2", angleB || torqueB ? `${label}: dashed` : ""],
        ["", "", desk.ghost && !angleB && !torqueB ? `${label} has no such joint` : ""], ["hatch", "--band", tubes.length ? "within three bands of the golden" : ""],
        ["band", "--band", bands.length ? "motor at its limit" : ""], ["dots", "--fail", reached ? "end of its range" : ""]]);
    } else leaveOut(element("motion"), "the recording has no angles of the joints (trace.columns).");
    this.drive(bands);
    this.seek(desk.state.t);
  }

  choose(): void { this.paint(); }
  zoom(): void { this.plots.forEach((p) => p.zoom()); }

  seek(t: number): void {
    this.plots.forEach((p) => p.seek(t));
    const { recording, loads, state: { joint } } = this.desk, now = (name: string) => recording.at(recording.channel(`joint.${joint}.${name}`), t);
    const motor = loads.motor(joint);
    const texts: Record<Cell, string> = {
      angle: `${fixed(now("angle"), 3)} rad`, error: `${fixed(now("setpoint") - now("angle"), 3)} rad`, speed: `${fixed(now("speed"), 2)} rad/s`,
      torque: `${fixed(now("torque"), decimalsOf(loads.peak, "N m"))} N m`, use: limited(motor) ? percent(Math.round(100 * loads.shareAt(joint, t)) / 100) : "no limit",
    };
    for (const [key, cell] of this.cells) cell.textContent = this.has(SOURCE[key]) ? texts[key] : "–";
  }

  // Of the chosen joint; in the list of numbers of any.
  private has(name: string): boolean { return this.desk.recording.has(`joint.${this.desk.state.joint}.${name}`); }

  // What the motor is told (volts, or N m of those that take a torque) and the current it draws.
  private drive(bands: Span[]): void {
    const { desk } = this, { ink, recording, state: { joint } } = desk, motor = desk.loads.motor(joint), unit = motor?.unit ?? "V";
    // What takes a torque has no voltage, and its command is in N m.
    const command = (unit === "V" ? ["voltage", "voltage_command"] : ["voltage_command"]).find((name) => this.has(name));
    const current = this.has("current") && recording.meta.joints.some((_, j) => recording.channel(`joint.${j}.current`).some((v) => v !== 0));
    const host = element("drive");
    host.hidden = element("drive-key").hidden = !command;
    if (!command) return;
    const word = unit === "V" ? "voltage" : "torque asked for", levels: Level[] = [{ value: 0, axis: "left", colour: ink.line }];
    const limits = (value: number | null | undefined, axis: Level["axis"], colour: string, dash: number[]) => {
      if (value && Number.isFinite(value)) levels.push({ value, axis, colour, dash }, { value: -value, axis, colour, dash });
    };
    limits(motor?.command, "left", ink.purple, [6, 4]);
    if (current) limits(motor?.current, "right", ink.green, [2, 4]);
    const { ghost } = desk, other = ghost?.values(`joint.${joint}.${command}`), drawn = current ? ghost?.values(`joint.${joint}.current`) : null;
    this.plots.push(new TimePlot(host, desk, {
      label: `${unit === "V" ? "Voltage and current" : "Command"} of joint ${recording.meta.joints[joint].name} over time`, bands, levels,
      left: { name: unit === "V" ? "voltage (V)" : "command (N m)", colour: ink.purple }, ...(current ? { right: { name: "current (A)", colour: ink.green } } : {}),
      curves: [
        { values: recording.channel(`joint.${joint}.${command}`), label: word, colour: ink.purple, axis: "left" },
        ...(current ? [{ values: recording.channel(`joint.${joint}.current`), label: "current", colour: ink.green, axis: "right" as const }] : []),
        ...(other ? [second(other, `${word}, ${ghost!.label}`, ink.purple, "left")] : []),
        ...(drawn ? [second(drawn, `current, ${ghost!.label}`, ink.green, "right")] : []),
      ],
    }));
    const of = (limit: number | null | undefined, u: string) => (limit ? `, limit ±${number(limit)} ${u}` : "");
    keys("drive-key", [["", "--purple", `${word} (left)${of(motor?.command, unit)}`], ["", "--green", current ? `current (right)${of(motor?.current, "A")}` : ""]]);
  }

  private saturated(): Span[] {
    const { recording, state: { joint } } = this.desk, flags = recording.find(`joint.${joint}.saturation`), out: Span[] = [];
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

  private nearStops(): boolean {
    const { recording, state: { joint } } = this.desk, { lo, hi } = recording.meta.joints[joint];
    if (lo === null || hi === null) return false;
    const room = 0.05 * (hi - lo);
    return recording.channel(`joint.${joint}.angle`).some((a) => a < lo + room || a > hi - room);
  }
}
