// Legends in the lower corners of the 3D picture: colours of the loads, scales of forces and of the grid, symbols.
import { ringGradient, type Theme } from "../colour";
import { level } from "./ground";
import { element } from "../dom";
import { number, quantity, rounded } from "../data/numbers";
import type { Desk } from "../panel";
import { dockName } from "../data/places";
import type { View } from "./view";

const longest = 92; // px, of the bar that shows a force

export class Legends {
  private width = ""; // width of the bar that shows a force
  constructor(
    private readonly desk: Desk,
    private readonly view: View,
  ) {
    const { meta } = desk.recording;
    element("grid-size").textContent = level(meta) ? `grid ${quantity(view.ground.spacing, "m")}` : "";
    for (const words of document.querySelectorAll<HTMLElement>("[data-gender]")) {
      words.hidden = !view.marks.hasFaces(words.dataset.gender!);
    }
  }

  paint(theme: Theme): void {
    for (const ramp of document.querySelectorAll<HTMLElement>("#stage .ramp")) {
      ramp.style.background = ringGradient(theme);
    }
    this.set();
  }

  /** Shows the legends of the parts that are switched on. */
  set(): void {
    const { view, desk } = this;
    const { recording, loads } = desk;
    const { marks, rings, support, travel, robot } = view;
    const show = (id: string, on: boolean) => {
      element(id).hidden = !on;
    };
    show("legend-load", recording.ran && recording.meta.joints.length > 0);
    element("ramp-words").textContent = `${robot.tinted ? "hinge, body" : "hinge"}: ${
      loads.limited ? "share of the available torque" : "torque, of the largest in this run"
    }`;
    show("legend-faces", marks.faces);
    show("legend-axes", marks.axes);
    show("legend-support", support.any && support.shown);
    element("support-words").textContent = support.anyPolygon ? "centre of mass; support polygon" : "centre of mass";
    show("legend-travel", travel.any && travel.shown);
    const chosen = recording.meta.docks[rings.chosen];
    show("legend-rings", rings.any && (rings.all || !!chosen));
    const words = !view.docks.any
      ? ""
      : view.docks.limited
        ? ", share of its strength"
        : ", load as a share of the largest";
    element("ring-words").textContent =
      `${chosen && !rings.all ? `ring: ${dockName(chosen.name)}` : "ring: a dock"}${words}`;
    this.scale();
  }

  /** Draws the bar of the forces for the present distance of the camera. */
  scale(): void {
    const { arrows } = this.view;
    const on = arrows.any && arrows.shown;
    element("legend-force").hidden = !on;
    if (!on) return;
    const perNewton = this.view.pixels(arrows.scale);
    const force = rounded(longest / perNewton);
    const width = `${(force * perNewton).toFixed(1)}px`;
    if (width === this.width) return;
    this.width = width;
    element("force-bar").style.width = width;
    element("force-words").textContent = `force of the ground, ${number(force)}\u00a0N`;
  }
}
