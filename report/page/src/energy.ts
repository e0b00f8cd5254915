// Where the energy went, and the electrical power over time.
import type { Values } from "./channels";
import { element, leaveOut, make } from "./dom";
import { keys } from "./keyline";
import { number, percent, quantity } from "./numbers";
import type { Desk, Panel } from "./panel";
import type { Recording } from "./recording";
import { second, TimePlot } from "./timeplot";

const sinks: [key: string, name: string, colour: string][] = [
  ["copper", "heat in the windings", "--vermillion"], ["gear", "gears", "--orange"], ["friction", "feet that slide", "--green"], ["contact", "impacts", "--sky"],
  ["stops", "hinge stops", "--fail"], ["stored", "stored", "--blue"], ["residual", "unaccounted", "--muted"],
];

export class Energy implements Panel {
  private plots: TimePlot[] = [];
  private readonly powers: (Values | null)[]; // of each run, by its own rows

  constructor(private readonly desk: Desk) {
    const { recording, runs } = desk, { meta } = recording, host = element("energy");
    this.powers = runs.map((r) => power(r.recording));
    element("power").hidden = !this.powers[0];
    element("energies").hidden = element("energies-key").hidden = !this.sums.length;
    const all = runs.map((r) => r.recording.meta), drawn = all.map((m) => m.summary.energy?.electrical ?? null);
    if (!drawn[0]) {
      leaveOut(host, !meta.motors.length ? "the joints have no motors." : meta.summary.energy ? "the motors draw nothing." : "the summary has no energies.");
      return;
    }
    all.forEach((m, n) => {
      const sum = drawn[n], words = ` drawn in ${number(m.duration)} s, ${quantity((sum ?? 0) / m.duration, "W")} on average`;
      host.append(make("p", ...(desk.ghost ? [`${desk.ghost.overlay.labels[n]}: `] : []), ...(sum ? [make("b", quantity(sum, "J")), words] : ["nothing is known of its energy"])));
    });
    const rows = sinks.filter(([key]) => all.some((m, n) => Math.abs(m.summary.energy?.[key] ?? 0) > 1e-4 * Math.abs(drawn[n] ?? Infinity)));
    host.append(make("div.ledger", ...rows.flatMap(([key, name, colour]) => all.flatMap((m, n) => {
      const value = m.summary.energy?.[key] ?? 0, sum = drawn[n], fill = make("i");
      if (!sum) return [];
      fill.style.cssText = `width:${Math.min(100, 100 * Math.abs(value / sum)).toFixed(1)}%;background:var(${colour})`;
      if (n) fill.style.opacity = "0.55";
      return [make("span", n ? desk.ghost!.label : name), make("span.bar", fill), make("span.n", quantity(value, "J")), make("span.n", percent(value / sum, 2))];
    }))));
    const created = meta.summary.energy?.created ?? 0;
    if (created > 0.02 * drawn[0]) host.append(make("p.note", `Gears that the load drives backwards gave ${quantity(created, "J")} too much (equation 2).`));
  }

  paint(): void {
    const { desk, powers: [own, theirs] } = this, { ink, recording, ghost } = desk;
    this.plots.forEach((p) => p.destroy());
    this.plots = [];
    if (own) {
      this.plots.push(new TimePlot(element("power"), desk, {
        label: "Electrical power of all joints over time", left: { name: "power (W)" }, levels: [{ value: 0, axis: "left", colour: ink.line }],
        curves: [{ values: own, label: "power", colour: ink.orange, width: 1.4, axis: "left" }, ...(theirs ? [second(ghost!.atRows(theirs), `power, ${ghost!.label}`, ink.purple, "left")] : [])],
      }));
    }
    if (this.sums.length) {
      this.plots.push(new TimePlot(element("energies"), desk, {
        label: "Energy from the start on: drawn by the motors, and where it went", left: { name: "energy (J)" }, levels: [{ value: 0, axis: "left", colour: ink.line }],
        curves: this.sums.map(([key, name, colour]) => ({ values: recording.channel(`energy.${key}`), label: name, colour: getComputedStyle(document.documentElement).getPropertyValue(colour), axis: "left" })),
      }));
      keys("energies-key", this.sums.map(([, name, colour]) => ["", colour, name]));
    }
    this.seek(desk.state.t);
  }

  zoom(): void { this.plots.forEach((p) => p.zoom()); }
  seek(t: number): void { this.plots.forEach((p) => p.seek(t)); }

  // Of the energies that the trace has, those that are drawn over time.
  private get sums(): typeof sinks {
    return ([["electrical", "drawn", "--ink2"], ...sinks] as typeof sinks).filter(([key]) => this.desk.recording.has(`energy.${key}`));
  }
}

/** Electrical power of all joints; null where nothing is known of it, or nothing is drawn. */
function power(recording: Recording): Values | null {
  const { joints } = recording.meta, known = (j: number) => recording.has(`joint.${j}.voltage`) && recording.has(`joint.${j}.current`);
  if (!joints.every(({ motor }, j) => motor === null || known(j))) return null;
  const sum = new Float32Array(recording.rows);
  joints.forEach((_, j) => {
    const u = recording.channel(`joint.${j}.voltage`), i = recording.channel(`joint.${j}.current`);
    sum.forEach((_w, k) => { sum[k] += u[k] * i[k]; });
  });
  return sum.some((p) => p !== 0) ? sum : null;
}
