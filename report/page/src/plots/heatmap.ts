// Heat map of the load of every joint over time. A darker colour means a larger load. A pixel shows the largest value
// of the rows that it covers, so that no peak is lost.
import { Board, fitted, font, type Pen } from "./board";
import type { Values } from "../data/channels";
import { difference, differenceGradient, gradient, load } from "../colour";
import { element, leaveOut } from "../dom";
import type { Quantity } from "../data/loads";
import { number } from "../data/numbers";
import type { Desk, Panel } from "../panel";
import { TimeRows } from "./time_rows";

const left = 96;
const foot = 22;
const channels: Record<Quantity, string> = { use: "torque", torque: "torque", current: "current", error: "setpoint" };
type Order = "number" | "load" | "top";
type Side = "own" | "second" | "difference";

export class HeatMap implements Panel {
  private readonly board: Board;
  private readonly host = element("heat");
  private readonly time: TimeRows;
  private quantity: Quantity;
  private order: Order = "number";
  private side: Side;
  private widest = 1; // value at the ends of the ramp of differences, as a share of the scale
  private readonly apart = new Map<string, Values | null>(); // values of the second run, or differences, by joint

  constructor(private readonly desk: Desk) {
    this.board = new Board(this.host, "Load of every joint over time", (pen, width, height) =>
      this.draw(pen, width, height),
    );
    this.time = new TimeRows(this.host, desk, left);
    const what = element<HTMLSelectElement>("what");
    const order = element<HTMLSelectElement>("order");
    const side = element<HTMLSelectElement>("side");
    this.offer(what, order);
    this.quantity = what.value as Quantity;
    if (!what.options.length) {
      leaveOut(this.host, "the recording has no torques of the joints (trace.columns), or they have no motors.");
    }
    this.side = desk.ghost ? "difference" : "own";
    this.offerSides(side);
    const on = (list: HTMLSelectElement, take: () => void) =>
      list.addEventListener("change", () => {
        take();
        this.paint();
      });
    on(side, () => (this.side = side.value as Side));
    on(what, () => (this.quantity = what.value as Quantity));
    on(order, () => (this.order = order.value as Order));
    this.host.addEventListener("click", (e) => this.click(e));
  }

  // Removes the choices of quantities that are not recorded, and the choice of the twelve worst joints if the robot has
  // at most twelve joints.
  private offer(what: HTMLSelectElement, order: HTMLSelectElement): void {
    const { recording, loads } = this.desk;
    for (const quantity of ["torque", "current", "error"] as const) {
      if (!recording.any(channels[quantity])) what.querySelector(`[value=${quantity}]`)?.remove();
    }
    if (!loads.limited) what.querySelector("[value=use]")?.remove();
    if (recording.meta.joints.length <= 12) order.querySelector("[value=top]")?.remove();
  }

  private offerSides(side: HTMLSelectElement): void {
    const labels = this.desk.ghost?.overlay.labels;
    side.hidden = !labels;
    if (!labels) return;
    [`${labels[1]} − ${labels[0]}`, ...labels].forEach((text, n) =>
      side.append(new Option(text, ["difference", "own", "second"][n])),
    );
  }

  paint(): void {
    if (!this.quantity) return; // no quantity is recorded, and the panel is hidden
    const rows = this.rows.length;
    const { loads, ink } = this.desk;
    const high = rows > 60 ? 3 : rows > 30 ? 11 : 16;
    this.host.style.minHeight = `${foot + Math.max(Math.min(44 * rows, 132), Math.min(620, rows * high))}px`;
    this.apart.clear();
    this.widest = this.side === "difference" ? this.reach() : 1;
    this.board.paint();
    const scale = loads.scale(this.quantity) * this.widest;
    const apart = this.side === "difference";
    const most = {
      use: `${number(100 * scale, 2)} %`,
      torque: `${number(scale)} N m`,
      current: `${number(scale)} A`,
      error: `${number(scale)} rad`,
    }[this.quantity];
    element("heat-least").textContent = apart ? `−${most}` : "0";
    element("heat-note").textContent =
      this.quantity === "use"
        ? `${apart ? "+" : ""}${most} of the torque available at that speed`
        : `${apart ? "+" : ""}${most}`;
    element("heat-ramp").style.background = apart ? differenceGradient(ink.theme) : gradient(ink.theme);
  }

  /**
   * Values of a joint by rows, as shares of the scale of the first run. Null if the selected quantity of the joint is
   * not recorded in a run that the heat map shows, or if only one of two runs has motors with known limits.
   */
  private values(joint: number): Values | null {
    const { loads, ghost, recording } = this.desk;
    const known = this.apart.get(String(joint));
    const channel = channels[this.quantity];
    if (this.side === "own" || !ghost) {
      return recording.has(`joint.${joint}.${channel}`) ? loads.of(this.quantity, joint) : null;
    }
    if (known !== undefined) return known;
    const theirs = ghost.number("joint", joint);
    let made: Values | null = null;
    if (
      theirs >= 0 &&
      ghost.recording.has(`joint.${theirs}.${channel}`) &&
      recording.has(`joint.${joint}.${channel}`) &&
      ghost.loads.limited === loads.limited
    ) {
      const to = ghost.loads.scale(this.quantity) / loads.scale(this.quantity);
      const own = loads.of(this.quantity, joint);
      made = ghost
        .atRows(ghost.loads.of(this.quantity, theirs))
        .map((v, i) => v * to - (this.side === "difference" ? own[i] : 0));
    }
    this.apart.set(String(joint), made);
    return made;
  }

  // Largest difference in the judged window. The start is excluded, because two runs often differ most there.
  private reach(): number {
    let most = 0;
    this.desk.recording.meta.joints.forEach((_, j) =>
      this.values(j)?.forEach((v, i) => {
        if (i >= this.desk.recording.judged && Math.abs(v) > most) most = Math.abs(v);
      }),
    );
    return most || 1;
  }

  choose(): void {
    this.board.paint();
  }
  zoom(): void {
    this.board.paint();
  }

  seek(t: number): void {
    this.time.seek(t);
  }

  private get rows(): number[] {
    const all = this.desk.recording.meta.joints.map((_, j) => j);
    const { peaks } = this.desk.loads;
    if (this.order !== "number") all.sort((a, b) => peaks[b] - peaks[a]);
    return this.order === "top" ? all.slice(0, 12) : all;
  }

  private click(e: MouseEvent): void {
    const { top, height } = this.host.getBoundingClientRect();
    const { rows, desk } = this;
    const row = rows[Math.floor(((e.clientY - top) / (height - foot)) * rows.length)];
    if (row === undefined) return;
    desk.choose(row);
    const t = this.time.timeAt(e);
    if (t !== null) desk.goTo(t);
  }

  private draw(pen: Pen, fullWidth: number, fullHeight: number): void {
    const { rows, desk } = this;
    const { ink, state } = desk;
    const width = Math.max(1, Math.floor(fullWidth - left));
    const height = fullHeight - foot;
    const each = height / rows.length;
    if (this.side !== "own") {
      // The hatching stays visible at times at which one of the runs has no value.
      pen.fillStyle = ink.hatch;
      pen.fillRect(left, 0, width, height);
    }
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.image(rows, width), left, 0, width, height);
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
    this.time.axis(pen, width, height + 7);
  }

  // Image of the loads, with one row of pixels per joint. Pixels without a known value are transparent.
  private image(rows: number[], width: number): HTMLCanvasElement {
    const { theme } = this.desk.ink;
    const edges = this.desk.recording.columns(this.desk.state.span, width);
    const pixels = new ImageData(width, rows.length);
    rows.forEach((j, r) => {
      const values = this.values(j);
      for (let x = 0; x < width && values; x++) {
        const most = extreme(values, edges[x], Math.max(edges[x] + 1, edges[x + 1]));
        if (most === null) continue;
        const colour = this.side === "difference" ? difference(theme, most / this.widest) : load(theme, most);
        pixels.data.set([...colour, 255], 4 * (r * width + x));
      }
    });
    const made = document.createElement("canvas");
    made.width = width;
    made.height = rows.length;
    made.getContext("2d")!.putImageData(pixels, 0, 0);
    return made;
  }

  // Writes the name of the chosen joint, and the names of other joints if they do not overlap.
  private names(pen: Pen, rows: number[], each: number, height: number): void {
    const { ink, recording, state } = this.desk;
    const middle = (r: number) => Math.min(Math.max((r + 0.5) * each, 6), height - 6);
    const chosen = rows.indexOf(state.joint);
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    let last = -99;
    rows.forEach((j, r) => {
      const y = middle(r);
      const mine = r === chosen;
      if (!mine && (y - last < 10.9 || (chosen >= 0 && Math.abs(y - middle(chosen)) < 10.9))) return;
      pen.font = font(11, mine ? 650 : 400);
      pen.fillStyle = mine ? ink.accent : ink.ink2;
      pen.fillText(fitted(pen, recording.meta.joints[j].name, left - 12), left - 8, y);
      if (!mine) last = y;
    });
  }
}

/** Value of largest magnitude in the rows `from` to `end` - 1; null if none of the values is known. */
function extreme(values: Values, from: number, end: number): number | null {
  let most = 0;
  let known = false;
  for (let i = from; i < end; i++) {
    known ||= !Number.isNaN(values[i]);
    if (Math.abs(values[i]) > Math.abs(most)) most = values[i];
  }
  return known ? most : null;
}
