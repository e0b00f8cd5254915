// Panel of the energy: parts into which the electrical energy divides, electrical power and energies over time.
import type { Values } from "../data/channels";
import { element, leaveOut, make } from "../dom";
import type { Meta } from "../data/format";
import { keys } from "../keyline";
import { number, percent, quantity } from "../data/numbers";
import type { Desk, Panel } from "../panel";
import type { Recording } from "../data/recording";
import { second, TimePlot } from "./timeplot";

const sinks: [key: string, name: string, colour: string][] = [
  ["copper", "heat in the windings", "--vermillion"],
  ["gear", "gears", "--orange"],
  ["friction", "feet that slide", "--green"],
  ["contact", "impacts", "--sky"],
  ["stops", "hinge stops", "--fail"],
  ["stored", "stored", "--blue"],
  ["residual", "unaccounted", "--muted"],
];

/** Row of the ledger: name, bar, energy, share of the electrical energy `sum`. Empty if `sum` is 0 or unknown. */
function bar(name: string, value: number, sum: number | null, colour: string, opacity: string): HTMLElement[] {
  if (!sum) return [];
  const fill = make("i");
  const width = Math.min(100, 100 * Math.abs(value / sum)).toFixed(1);
  fill.style.cssText = `width:${width}%;background:var(${colour})`;
  fill.style.opacity = opacity;
  return [
    make("span", name),
    make("span.bar", fill),
    make("span.n", quantity(value, "J")),
    make("span.n", percent(value / sum, 2)),
  ];
}

/** Reason for which the panel of the energy is left out. */
function lacking({ motors, summary }: Meta): string {
  if (!motors.length) return "the joints have no motors.";
  return summary.energy ? "the motors draw nothing." : "the summary has no energies.";
}

/** Energy that the motors of a run draw, and its average power. */
function total({ duration }: Meta, drawn: number | null, label?: string): HTMLElement {
  const words = ` drawn in ${number(duration)} s, ${quantity((drawn ?? 0) / duration, "W")} on average`;
  return make(
    "p",
    ...(label === undefined ? [] : [`${label}: `]),
    ...(drawn ? [make("b", quantity(drawn, "J")), words] : ["its energy is unknown"]),
  );
}

export class Energy implements Panel {
  private plots: TimePlot[] = [];
  private readonly powers: (Values | null)[]; // electrical power, by run and row of that run, W

  constructor(private readonly desk: Desk) {
    this.powers = desk.runs.map((r) => power(r.recording));
    element("power").hidden = !this.powers[0];
    element("energies").hidden = element("energies-key").hidden = !this.sums.length;
    this.list();
  }

  /** Lists the energies of the runs as numbers and bars. */
  private list(): void {
    const { recording, runs, ghost } = this.desk;
    const { energy } = recording.meta.summary;
    const host = element("energy");
    const all = runs.map((r) => r.recording.meta);
    const drawn = all.map((m) => m.summary.energy?.electrical ?? null);
    if (!drawn[0]) {
      leaveOut(host, lacking(recording.meta));
      return;
    }
    host.append(...all.map((m, n) => total(m, drawn[n], ghost?.overlay.labels[n])));
    const rows = sinks.filter(([key]) =>
      all.some((m, n) => Math.abs(m.summary.energy?.[key] ?? 0) > 1e-4 * Math.abs(drawn[n] ?? Infinity)),
    );
    const bars = rows.flatMap(([key, name, colour]) =>
      all.flatMap((m, n) =>
        bar(n ? ghost!.label : name, m.summary.energy?.[key] ?? 0, drawn[n], colour, n ? "0.55" : ""),
      ),
    );
    host.append(make("div.ledger", ...bars));
    const created = energy?.created ?? 0;
    if (created > 0.02 * drawn[0]) {
      host.append(
        make("p.note", `Gears that the load drives backwards gave ${quantity(created, "J")} too much (equation 2).`),
      );
    }
  }

  paint(): void {
    const { desk } = this;
    const [own, theirs] = this.powers;
    const { ink, recording, ghost } = desk;
    this.plots.forEach((p) => p.destroy());
    this.plots = [];
    if (own) {
      this.plots.push(
        new TimePlot(element("power"), desk, {
          label: "Electrical power of all joints over time",
          left: { name: "power (W)" },
          levels: [{ value: 0, axis: "left", colour: ink.line }],
          curves: [
            { values: own, label: "power", colour: ink.orange, width: 1.4, axis: "left" },
            ...second(theirs && ghost!.atRows(theirs), `power, ${ghost?.label}`, ink.purple, "left"),
          ],
        }),
      );
    }
    if (this.sums.length) {
      this.plots.push(
        new TimePlot(element("energies"), desk, {
          label: "Energy from the start on: drawn by the motors, and its use",
          left: { name: "energy (J)" },
          levels: [{ value: 0, axis: "left", colour: ink.line }],
          curves: this.sums.map(([key, name, colour]) => ({
            values: recording.channel(`energy.${key}`),
            label: name,
            colour: getComputedStyle(document.documentElement).getPropertyValue(colour),
            axis: "left",
          })),
        }),
      );
      keys(
        "energies-key",
        this.sums.map(([, name, colour]) => ["", colour, name]),
      );
    }
    this.seek(desk.state.t);
  }

  zoom(): void {
    this.plots.forEach((p) => p.zoom());
  }
  seek(t: number): void {
    this.plots.forEach((p) => p.seek(t));
  }

  // Parts of the energy that are recorded over time, and thus appear in the plot.
  private get sums(): typeof sinks {
    return ([["electrical", "drawn", "--ink2"], ...sinks] as typeof sinks).filter(([key]) =>
      this.desk.recording.has(`energy.${key}`),
    );
  }
}

/** Electrical power of all joints, W; null if a voltage or current is not recorded, or if the motors draw nothing. */
function power(recording: Recording): Values | null {
  const { joints } = recording.meta;
  const known = (j: number) => recording.has(`joint.${j}.voltage`) && recording.has(`joint.${j}.current`);
  if (!joints.every(({ motor }, j) => motor === null || known(j))) return null;
  const sum = new Float32Array(recording.rows);
  joints.forEach((_, j) => {
    const u = recording.channel(`joint.${j}.voltage`);
    const i = recording.channel(`joint.${j}.current`);
    sum.forEach((_w, k) => {
      sum[k] += u[k] * i[k];
    });
  });
  return sum.some((p) => p !== 0) ? sum : null;
}
