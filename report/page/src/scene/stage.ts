// Panel of the 3D picture: buttons, labels, and clicks on hinges. Without WebGL 2, the panel contains only a note, and
// the other panels work.
import type { Vector3 } from "three";
import { element, make } from "../dom";
import type { Part } from "../data/format";
import { Labels } from "./labels";
import { Legends } from "./legends";
import { decimalsOf, fixed, percent } from "../data/numbers";
import type { Desk, Panel } from "../panel";
import { dockAt, partName } from "../data/places";
import { spot, surroundings } from "./spot";
import { View, type Look } from "./view";

export class Stage implements Panel {
  readonly view: View | null;
  private readonly host = element("stage");
  private readonly tag = element("tag");
  private readonly labels = new Labels(element("names"));
  private readonly legends: Legends | null = null;
  private marked: [part: Part, name: string | null] | null = null; // part that the tag names; null for the joint
  private image: HTMLImageElement | null = null;

  constructor(
    private readonly desk: Desk,
    align: (on: boolean) => void,
  ) {
    const canvas = element<HTMLCanvasElement>("view");
    this.view = opened(canvas, desk);
    if (!this.view) {
      // Hiding the buttons also disables their keys.
      for (const part of document.querySelectorAll<HTMLElement>("#stage *, .stage .tools *")) part.hidden = true;
      this.host.append(
        make("p.empty", "This browser cannot draw in 3D (it has no WebGL 2). Everything else on this page works."),
      );
      return;
    }
    const { view } = this;
    const { ran, meta } = desk.recording;
    this.legends = new Legends(desk, view);
    for (const b of document.querySelectorAll<HTMLElement>("[data-look]")) {
      b.addEventListener("click", () => view.look(b.dataset.look as Look));
    }
    this.option("follow", ran, view, "follow");
    this.option("tint", ran && meta.joints.length > 0, view.robot, "tinted");
    this.option("forces", view.arrows.any, view.arrows, "shown");
    this.option("balance-marks", view.support.any, view.support, "shown");
    this.option("travel", view.travel.any, view.travel, "shown");
    this.option("faces", view.marks.anyFaces, view.marks, "faces");
    this.option("axes", meta.joints.length > 0, view.marks, "axes");
    this.option("rings", view.rings.any, view.rings, "all");
    const { ghost } = desk;
    this.toggle("align", !!ghost?.periodic, () => !!ghost?.aligned, align);
    this.pointer(canvas, view);
    new ResizeObserver(() => view.resize()).observe(this.host);
  }

  paint(): void {
    this.view?.resize();
    this.view?.paint(this.desk.ink.theme);
    this.legends?.paint(this.desk.ink.theme);
  }

  /** Names a part instead of the joint, and draws a ring around a dock. */
  mark(part: Part, name: string | null): void {
    this.marked = part === "joint" ? null : [part, name];
    this.view?.mark(dockAt(this.desk.recording.meta, part, name));
    this.legends?.set();
  }

  seek(t: number): void {
    this.view?.set(t);
  }
  choose(): void {
    this.marked = null;
    this.view?.select(this.desk.state.joint);
  }

  /** Draws the picture and its labels if something has changed. Returns true if it has drawn. */
  draw(): boolean {
    if (!this.view?.render()) return false;
    this.annotate(this.view);
    this.legends?.scale();
    return true;
  }

  /** Moves the camera to a joint; -1 shows the whole robot. */
  frame(joint: number): void {
    const { view } = this;
    const pivot = view?.kinematics.pivots[joint];
    view?.look("iso", pivot && surroundings(pivot, 1.6 * view.robot.unit));
  }

  switch(what: "faces" | "axes"): void {
    element(what).click();
  }

  /** Covers the canvas by a picture for printing if `on` is true, otherwise removes the picture. */
  freeze(on: boolean): void {
    this.image?.remove();
    this.image = null;
    if (!on || !this.view) return;
    this.image = make("img.still");
    this.image.alt = "The robot at the selected time";
    this.image.src = this.view.image();
    this.host.append(this.image);
  }

  /** Connects a button to a property that it switches on and off. The button is hidden if `useful` is false. */
  private option<Key extends string>(id: string, useful: boolean, of: Record<Key, boolean>, key: Key): void {
    this.toggle(
      id,
      useful,
      () => of[key],
      (on) => {
        of[key] = on;
      },
    );
  }

  private toggle(id: string, useful: boolean, get: () => boolean, set: (on: boolean) => void): void {
    const button = element<HTMLButtonElement>(id);
    button.hidden = !useful;
    button.setAttribute("aria-pressed", String(get()));
    button.addEventListener("click", () => {
      set(!get());
      button.setAttribute("aria-pressed", String(get()));
      this.view?.set(this.desk.state.t);
      this.legends?.set();
    });
  }

  private annotate(view: View): void {
    const { recording, state } = this.desk;
    const { joints } = recording.meta;
    const j = view.hovered >= 0 ? view.hovered : state.joint;
    const part = view.hovered >= 0 ? null : this.marked;
    if (part) {
      const at = spot({ meta: recording.meta, kinematics: view.kinematics, rings: view.rings }, ...part);
      this.point(at && view.project(at), partName(recording.meta, part[0], part[1] ?? ""));
    } else this.point(j >= 0 ? view.place(j) : null, joints[j]?.name, this.load(j));
    const mass = view.support.shown && view.support.any ? view.project(view.support.centre) : null;
    element("mass").hidden = !mass;
    if (mass) element("mass").style.transform = `translate(${mass.map((x) => `${(x - 9).toFixed(1)}px`).join(",")})`;
    const order = joints.map((_, k) => k).filter((k) => k !== j);
    const label = (text: string, at: Vector3) => {
      const tip = view.project(at);
      return tip ? [{ text, x: tip[0], y: tip[1] }] : [];
    };
    const above = 16; // pixels, so that the name does not hide its sensor
    this.labels.show([
      ...view.marks.sensorsAt().flatMap(({ name, at }) => label(name, at).map((l) => ({ ...l, y: l.y - above }))),
      ...(view.marks.axes ? order.flatMap((k) => label(joints[k].name, view.marks.tip(k))) : []),
    ]);
  }

  /** Torque and load of a joint at the time shown; "" if they are not recorded. */
  private load(j: number): string {
    const { recording, loads, state } = this.desk;
    const torque = recording.find(`joint.${j}.torque`);
    if (!recording.ran || !torque) return "";
    const share = loads.limited ? `, ${percent(Math.round(100 * loads.shareAt(j, state.t)) / 100)}` : "";
    return ` ${fixed(recording.at(torque, state.t), decimalsOf(loads.peak, "N m"))} N m${share}`;
  }

  /** Writes a name and numbers next to a place in the picture; hides the text without a place. */
  private point(at: [number, number] | null, name = "", numbers = ""): void {
    this.tag.hidden = !at;
    if (!at) return;
    const width = this.host.clientWidth;
    this.tag.replaceChildren(make("b", name), numbers);
    const half = this.tag.offsetWidth / 2;
    const x = Math.min(Math.max(at[0], half + 8), width - half - 8);
    const under = at[1] < 84;
    this.tag.classList.toggle("under", under);
    this.tag.style.setProperty("--point", `${(at[0] - x + half).toFixed(1)}px`);
    const y = under ? `${(at[1] + 22).toFixed(1)}px` : `calc(${(at[1] - 20).toFixed(1)}px - 100%)`;
    this.tag.style.transform = `translate(${(x - half).toFixed(1)}px, ${y})`;
  }

  private pointer(canvas: HTMLCanvasElement, view: View): void {
    let down: [number, number] | null = null;
    canvas.addEventListener("pointerdown", (e) => {
      down = [e.clientX, e.clientY];
    });
    canvas.addEventListener("pointerup", (e) => {
      const still = down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 5;
      const joint = still ? view.pick(e.clientX, e.clientY) : -1;
      down = null;
      if (joint >= 0) this.desk.choose(joint);
    });
    canvas.addEventListener("pointermove", (e) => {
      if (!e.buttons) hover(view.pick(e.clientX, e.clientY));
    });
    canvas.addEventListener("pointerleave", () => hover(-1));
    canvas.addEventListener("dblclick", (e) => this.frame(view.pick(e.clientX, e.clientY)));
    const hover = (joint: number) => {
      if (joint === view.hovered) return;
      view.hovered = joint;
      canvas.style.cursor = joint >= 0 ? "pointer" : "grab";
      view.set(this.desk.state.t);
    };
  }
}

/** View of the scene, or null without WebGL 2. The test uses another canvas, to avoid an error in the console. */
function opened(canvas: HTMLCanvasElement, desk: Desk): View | null {
  if (!document.createElement("canvas").getContext("webgl2")) return null;
  return new View(desk, canvas);
}
