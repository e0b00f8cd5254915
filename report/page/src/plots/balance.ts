// Plot of the stability margin and of the height of the centre of mass over time. The stability margin is the distance
// of the centre of mass to the edge of the support polygon.
import { element } from "../dom";
import { keys } from "../keyline";
import type { Desk, Panel } from "../panel";
import { curve, second, TimePlot } from "./timeplot";

export class Balance implements Panel {
  private plot: TimePlot | null = null;

  constructor(private readonly desk: Desk) {
    element("balance").hidden = element("balance-key").hidden = !desk.recording.has("stability");
  }

  paint(): void {
    this.plot?.destroy();
    const { recording, ink, ghost } = this.desk;
    const margin = recording.find("stability");
    const height = recording.find("com.z");
    const other = ghost?.values("stability");
    const high = height && ghost?.values("com.z");
    if (!margin) return;
    this.plot = new TimePlot(element("balance"), this.desk, {
      label: "Distance of the centre of mass to the edge of the support polygon, and its height, over time",
      left: { name: "margin (m)", colour: ink.green },
      ...(height ? { right: { name: "height (m)", colour: ink.sky } } : {}),
      levels: [{ value: 0, axis: "left", colour: ink.line }],
      curves: [
        { values: margin, label: "margin", colour: ink.green, axis: "left" },
        ...curve(height, { label: "height", colour: ink.sky, axis: "right" }),
        ...second(other, `margin, ${ghost?.label}`, ink.green, "left"),
        ...second(high, `height, ${ghost?.label}`, ink.sky, "right"),
      ],
    });
    keys("balance-key", [
      ["", "--green", "from the edge of the support polygon, inside positive (left)"],
      ["", "--sky", height ? "height (right)" : ""],
      ["dash", "--ink2", other || high ? `${ghost!.label}: dashed` : ""],
    ]);
    this.seek(this.desk.state.t);
  }

  zoom(): void {
    this.plot?.zoom();
  }
  seek(t: number): void {
    this.plot?.seek(t);
  }
}
