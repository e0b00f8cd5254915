// Where the energy went, and the electrical power over time.
import type { Values } from "./channels";
import { element, leaveOut, make } from "./dom";
import { number, percent } from "./numbers";
import type { Desk, Panel } from "./panel";
import { TimePlot } from "./timeplot";

const sinks: [key: string, name: string, colour: string][] = [
  ["copper", "heat in the windings", "--vermillion"], ["gear", "gears", "--orange"], ["friction", "feet that slide", "--green"], ["contact", "impacts", "--sky"],
  ["stops", "hinge stops", "--fail"], ["stored", "stored", "--blue"], ["residual", "unaccounted", "--muted"],
];

export class Energy implements Panel {
  private plot: TimePlot | null = null;
  private readonly power: Values | null;

  constructor(private readonly desk: Desk) {
    const { recording } = desk, { joints, summary: { energy } } = recording.meta;
    this.power = joints.length && recording.has("joint.0.voltage") && recording.has("joint.0.current") ? new Float32Array(recording.rows) : null;
    joints.forEach((_, j) => {
      const u = recording.channel(`joint.${j}.voltage`), i = recording.channel(`joint.${j}.current`);
      this.power?.forEach((_, k) => { this.power![k] += u[k] * i[k]; });
    });
    if (!this.power?.some((p) => p !== 0)) this.power = null;
    element("power").hidden = !this.power;
    const drawn = energy?.electrical ?? null, host = element("energy");
    if (!energy || !drawn) {
      leaveOut(host, !recording.meta.motors.length ? "the joints have no motors." : energy ? "the motors draw nothing." : "the summary has no energies.");
      return;
    }
    const rows = sinks.filter(([key]) => Math.abs(energy[key] ?? 0) > 1e-4 * Math.abs(drawn));
    host.append(make("p", make("b", `${number(drawn)} J`), ` drawn in ${number(recording.meta.duration)} s, ${number(drawn / recording.meta.duration)} W on average`),
      make("div.ledger", ...rows.flatMap(([key, name, colour]) => {
        const value = energy[key]!, fill = make("i");
        fill.style.cssText = `width:${Math.min(100, 100 * Math.abs(value / drawn)).toFixed(1)}%;background:var(${colour})`;
        return [make("span", name), make("span.bar", fill), make("span.n", `${number(value)} J`), make("span.n", percent(value / drawn, 2))];
      })));
    if ((energy.created ?? 0) > 0.02 * drawn) host.append(make("p.note", `Gears that the load drives backwards gave ${number(energy.created)} J too much (equation 2).`));
  }

  paint(): void {
    this.plot?.destroy();
    if (!this.power) return;
    const { ink } = this.desk;
    this.plot = new TimePlot(element("power"), this.desk, {
      label: "Electrical power of all joints over time", left: { name: "power (W)" }, levels: [{ value: 0, axis: "left", colour: ink.line }],
      curves: [{ values: this.power, label: "power", colour: ink.orange, width: 1.4, axis: "left" }],
    });
    this.seek(this.desk.state.t);
  }

  zoom(): void { this.plot?.zoom(); }
  seek(t: number): void { this.plot?.seek(t); }
}
