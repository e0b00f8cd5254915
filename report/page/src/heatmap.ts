// Every joint over time, darker: more. Of the rows that share a pixel the largest is shown, so no peak is lost.
import { Board, fitted, font, timeAxis, type Pen } from "./board";
import type { Values } from "./channels";
import { difference, differenceGradient, gradient, load } from "./colour";
import { element, leaveOut } from "./dom";
import type { Quantity } from "./loads";
import { number } from "./numbers";
import type { Desk, Panel } from "./panel";

const left = 96, foot = 22;
type Order = "number" | "load" | "top";
type Side = "own" | "second" | "difference";

export class HeatMap implements Panel {
  private readonly board: Board;
  private readonly host = element("heat");
  private readonly head: HTMLElement;
  private quantity: Quantity;
  private order: Order = "number";
  private side: Side;
  private widest = 1; // of the scale: where the ramp of differences ends
  private readonly apart = new Map<string, Values | null>(); // what the difference or the second run is, by joint

  constructor(private readonly desk: Desk) {
    this.board = new Board(this.host, "Load of every joint over time", (pen, width, height) => this.draw(pen, width, height));
    this.head = this.host.querySelector<HTMLElement>(".playhead")!;
    const what = element<HTMLSelectElement>("what"), order = element<HTMLSelectElement>("order");
    for (const [value, channel] of [["torque", "torque"], ["current", "current"], ["error", "setpoint"]]) {
      if (!desk.recording.any(channel)) what.querySelector(`[value=${value}]`)?.remove();
    }
    if (!desk.loads.limited) what.querySelector("[value=use]")?.remove();
    if (desk.recording.meta.joints.length <= 12) order.querySelector("[value=top]")?.remove();
    this.quantity = what.value as Quantity;
    if (!what.options.length) leaveOut(this.host, "the recording has no torques of the joints (trace.columns), or they have no motors.");
    const side = element<HTMLSelectElement>("side"), labels = desk.ghost?.overlay.labels;
    side.hidden = !labels;
    this.side = labels ? "difference" : "own";
    if (labels) [`${labels[1]} − ${labels[0]}`, ...labels].forEach((text, n) => side.append(new Option(text, ["difference", "own", "second"][n])));
    side.addEventListener("change", () => { this.side = side.value as Side; this.paint(); });
    what.addEventListener("change", () => { this.quantity = what.value as Quantity; this.paint(); });
    order.addEventListener("change", () => { this.order = order.value as Order; this.paint(); });
    this.host.addEventListener("click", (e) => this.click(e));
  }

  paint(): void {
    if (!this.quantity) return; // left out
    const rows = this.rows.length, { loads, ink } = this.desk;
    this.host.style.minHeight = `${foot + Math.max(Math.min(44 * rows, 132), Math.min(620, rows * (rows > 60 ? 3 : rows > 30 ? 11 : 16)))}px`;
    this.apart.clear();
    this.widest = this.side === "difference" ? this.reach() : 1;
    this.board.paint();
    const scale = loads.scale(this.quantity) * this.widest, apart = this.side === "difference";
    const most = { use: `${number(100 * scale, 2)} %`, torque: `${number(scale)} N m`, current: `${number(scale)} A`, error: `${number(scale)} rad` }[this.quantity];
    element("heat-least").textContent = apart ? `−${most}` : "0";
    element("heat-note").textContent = this.quantity === "use" ? `${apart ? "+" : ""}${most} of what the motor can give at that speed` : `${apart ? "+" : ""}${most}`;
    element("heat-ramp").style.background = apart ? differenceGradient(ink.theme) : gradient(ink.theme);
  }

  /** What is drawn of a joint, by rows, a share of the scale; null: a run has no such joint, or the joint no motor. */
  private values(joint: number): Values | null {
    const { loads, ghost, recording } = this.desk, known = this.apart.get(String(joint));
    const channel = { use: "torque", torque: "torque", current: "current", error: "setpoint" }[this.quantity];
    if (this.side === "own" || !ghost) return recording.has(`joint.${joint}.${channel}`) ? loads.of(this.quantity, joint) : null;
    if (known !== undefined) return known;
    const theirs = ghost.number("joint", joint);
    let made: Values | null = null;
    if (theirs >= 0 && ghost.recording.has(`joint.${theirs}.${channel}`) && recording.has(`joint.${joint}.${channel}`) && ghost.loads.limited === loads.limited) {
      const to = ghost.loads.scale(this.quantity) / loads.scale(this.quantity), own = loads.of(this.quantity, joint);
      made = ghost.atRows(ghost.loads.of(this.quantity, theirs)).map((v, i) => v * to - (this.side === "difference" ? own[i] : 0));
    }
    this.apart.set(String(joint), made);
    return made;
  }

  // The largest difference after the start, in which two runs often part most.
  private reach(): number {
    let most = 0;
    this.desk.recording.meta.joints.forEach((_, j) => this.values(j)?.forEach((v, i) => { if (i >= this.desk.recording.judged && Math.abs(v) > most) most = Math.abs(v); }));
    return most || 1;
  }

  choose(): void { this.board.paint(); }
  zoom(): void { this.board.paint(); }

  seek(t: number): void {
    const [from, to] = this.desk.state.span, x = (t - from) / (to - from);
    this.head.style.display = x >= 0 && x <= 1 ? "" : "none";
    this.head.style.transform = `translateX(${left + x * (this.host.clientWidth - left)}px)`;
  }

  private get rows(): number[] {
    const all = this.desk.recording.meta.joints.map((_, j) => j), { peaks } = this.desk.loads;
    if (this.order !== "number") all.sort((a, b) => peaks[b] - peaks[a]);
    return this.order === "top" ? all.slice(0, 12) : all;
  }

  private click(e: MouseEvent): void {
    const { left: x0, top, width, height } = this.host.getBoundingClientRect(), { rows, desk } = this, [from, to] = desk.state.span;
    const row = rows[Math.floor((e.clientY - top) / (height - foot) * rows.length)], x = (e.clientX - x0 - left) / (width - left);
    if (row === undefined) return;
    desk.choose(row);
    if (x >= 0) desk.goTo(from + x * (to - from));
  }

  private draw(pen: Pen, fullWidth: number, fullHeight: number): void {
    const { rows, desk } = this, { ink, recording, state } = desk, width = Math.max(1, Math.floor(fullWidth - left)), height = fullHeight - foot, each = height / rows.length;
    const image = new ImageData(width, rows.length), [from, to] = state.span;
    const edges = Array.from({ length: width + 1 }, (_, x) => recording.row(from + (to - from) * x / width));
    rows.forEach((j, r) => {
      const values = this.values(j), apart = this.side === "difference";
      for (let x = 0; x < width && values; x++) {
        let most = 0, known = false;
        for (let i = edges[x], end = Math.max(edges[x] + 1, edges[x + 1]); i < end; i++) {
          known ||= !Number.isNaN(values[i]);
          if (Math.abs(values[i]) > Math.abs(most)) most = values[i];
        }
        if (known) image.data.set([...(apart ? difference(ink.theme, most / this.widest) : load(ink.theme, most)), 255], 4 * (r * width + x));
      }
    });
    const off = document.createElement("canvas");
    off.width = width;
    off.height = rows.length;
    off.getContext("2d")!.putImageData(image, 0, 0);
    if (this.side !== "own") { // where one of the runs has nothing
      pen.fillStyle = ink.hatch;
      pen.fillRect(left, 0, width, height);
    }
    pen.imageSmoothingEnabled = false;
    pen.drawImage(off, left, 0, width, height);
    if (each > 7) {
      pen.fillStyle = ink.panel;
      for (let r = 1; r < rows.length; r++) pen.fillRect(left, r * each - 0.5, width, 1);
    }
    this.names(pen, rows, each, height);
    const chosen = rows.indexOf(state.joint);
    if (chosen >= 0) {
      pen.strokeStyle = ink.accent;
      pen.lineWidth = 1.5;
      pen.strokeRect(left + 0.75, chosen * each + 0.75, width - 1.5, Math.max(each - 1.5, 2));
    }
    timeAxis(pen, ink, left, width, height + 7, state.span);
    this.seek(state.t);
  }

  // As many names as there is room for; always that of the chosen joint.
  private names(pen: Pen, rows: number[], each: number, height: number): void {
    const { ink, recording, state } = this.desk, middle = (r: number) => Math.min(Math.max((r + 0.5) * each, 6), height - 6), chosen = rows.indexOf(state.joint);
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    let last = -99;
    rows.forEach((j, r) => {
      const y = middle(r), mine = r === chosen;
      if (!mine && (y - last < 10.9 || (chosen >= 0 && Math.abs(y - middle(chosen)) < 10.9))) return;
      pen.font = font(11, mine ? 650 : 400);
      pen.fillStyle = mine ? ink.accent : ink.ink2;
      pen.fillText(fitted(pen, recording.meta.joints[j].name, left - 12), left - 8, y);
      if (!mine) last = y;
    });
  }
}
