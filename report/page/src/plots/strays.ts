// Table and plot of the signals that left their bands around the golden, ordered by the time at which they did.
import { element, link, make, panelOf, rowHead, tableHead } from "../dom";
import type { Stray } from "../data/format";
import { keys } from "../keyline";
import { fixed, number } from "../data/numbers";
import type { Desk, Panel, Run } from "../panel";
import { TimePlot } from "./timeplot";

/** Name of a channel in texts, for example `m5/active torque` for joint.9.torque. */
function signalName(run: Run, signal: string): string {
  const [, joint, quantity] = /^joint\.(\d+)\.(.*)$/.exec(signal) ?? [];
  const { joints } = run.recording.meta;
  return joint === undefined ? signal : `${joints[Number(joint)]?.name ?? `joint ${joint}`} ${quantity}`;
}

/** Number of the joint of a stray signal; -1 if the signal does not belong to a joint. */
export const jointOf = ({ signal }: Stray): number => Number(/^joint\.(\d+)\./.exec(signal)?.[1] ?? -1);

export function signalLink(run: Run, stray: Stray): HTMLButtonElement {
  const joint = jointOf(stray);
  return link(signalName(run, stray.signal), () => {
    if (joint >= 0) run.choose(joint);
    if (stray.from !== null) run.goTo(stray.from);
  });
}

export class Strays implements Panel {
  private shown: Stray | null;
  private plot: TimePlot | null = null;

  constructor(private readonly desk: Desk) {
    const { strays } = desk.ghost!.overlay;
    const body = make("tbody");
    this.shown = strays.find((s) => jointOf(s) === desk.state.joint) ?? strays[0] ?? null;
    panelOf("drift").hidden = !this.shown;
    for (const stray of strays) {
      const signal = signalLink(desk, stray);
      signal.addEventListener("click", () => this.show(stray));
      body.append(
        make(
          "tr",
          rowHead(signal),
          make("td", number(stray.ratio)),
          make("td", stray.from === null ? "never" : fixed(stray.from, 2)),
          make("td", `±${number(stray.tolerance)} ${stray.unit}`),
        ),
      );
    }
    const head = tableHead(["signal"], ["RMS", "bands"], ["outside from", "s"], ["tolerance"]);
    if (strays.length) element("strays").append(head, body);
    element("strays-note").textContent = strays.length
      ? "A signal fails if the RMS of its difference from the golden exceeds one band. It is outside from the time " +
        "at which the difference first exceeds three bands, which is the tolerance."
      : "No signal left its band. Numbers did; the terminal lists them.";
  }

  paint(): void {
    this.plot?.destroy();
    this.plot = null;
    const { desk, shown } = this;
    const { ink, recording } = desk;
    const difference = shown && desk.ghost!.difference(shown.signal);
    if (!shown || !difference) return;
    const [golden, now] = desk.ghost!.overlay.labels;
    const dash = [6, 4];
    const name = signalName(desk, shown.signal);
    element("drift-note").textContent = name;
    this.plot = new TimePlot(element("drift"), desk, {
      label: `Difference of ${name}, ${now} minus ${golden}, over time`,
      left: { name: `difference (${shown.unit || "1"})`, colour: ink.ink2 },
      levels: [
        { value: 0, axis: "left", colour: ink.line },
        ...[1, -1].map((sign) => ({ value: sign * shown.tolerance, axis: "left" as const, colour: ink.green, dash })),
      ],
      curves: [
        {
          values: Float32Array.from(recording.times, (_, i) => difference[i] ?? NaN),
          label: "difference",
          colour: ink.vermillion,
          axis: "left",
        },
      ],
    });
    keys("drift-key", [
      ["", "--vermillion", `${now} less ${golden}`],
      ["dash", "--green", "three bands"],
    ]);
    this.seek(desk.state.t);
  }

  choose(): void {
    const own = this.desk.ghost!.overlay.strays.find((s) => jointOf(s) === this.desk.state.joint);
    if (own && this.shown && jointOf(this.shown) !== this.desk.state.joint) this.show(own);
  }

  zoom(): void {
    this.plot?.zoom();
  }
  seek(t: number): void {
    this.plot?.seek(t);
  }

  private show(stray: Stray): void {
    this.shown = stray;
    this.paint();
  }
}
