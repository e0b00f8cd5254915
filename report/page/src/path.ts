// The way of the centre of mass from above, one scale both ways, with the prints of the feet.
import { Board, frame, type Box, type Pen, type Scale } from "./board";
import type { Values } from "./channels";
import { element, leaveOut } from "./dom";
import { keys } from "./keyline";
import type { Desk, Panel } from "./panel";

export class Path implements Panel {
  private readonly board: Board | null = null;
  private readonly dot = element("path-dot");
  private scale: Scale | null = null;
  private readonly x: Values;
  private readonly y: Values;
  private readonly prints: [Values, Values, Values][];

  constructor(private readonly desk: Desk) {
    const { recording } = desk;
    [this.x, this.y] = ["x", "y"].map((c) => recording.channel(`com.${c}`));
    const feet = recording.meta.feet.map((_, n) => ["fz", "x", "y"].map((c) => recording.find(`foot.${n}.${c}`)));
    this.prints = feet.length <= 12 ? feet.filter((f): f is [Values, Values, Values] => f.every((v) => v)) : [];
    if (!recording.has("com.x")) {
      leaveOut(element("path"), "the recording has no centre of mass (trace.columns: com.*).");
      return;
    }
    keys("path-key", [["", "--blue", "centre of mass"], ["ring", "--blue", "start"], ["dotk", "--green", this.prints.length ? "feet on the ground" : ""],
      ["dash", "--purple", this.second ? `centre of mass, ${desk.ghost!.label}` : ""]]);
    this.board = new Board(element("path"), "Way of the centre of mass from above", (pen, width, height) => this.draw(pen, width, height));
  }

  // By its own rows: its way does not depend on the clock.
  private get second(): [Values, Values] | null {
    const x = this.desk.ghost?.recording.find("com.x"), y = this.desk.ghost?.recording.find("com.y");
    return x && y ? [x, y] : null;
  }

  paint(): void { this.board?.paint(); }

  seek(t: number): void {
    if (!this.scale) return;
    const { recording } = this.desk;
    this.dot.style.transform = `translate(${this.scale.X(recording.at(this.x, t))}px,${this.scale.Y(recording.at(this.y, t))}px)`;
  }

  private draw(pen: Pen, width: number, height: number): void {
    const { x, y, desk } = this, { ink, recording } = desk, box: Box = { left: 58, right: width - 14, top: 10, bottom: height - 44 }, n = recording.rows;
    const reach: [number, number, number, number] = [Infinity, -Infinity, Infinity, -Infinity];
    const see = (a: Values, b: Values, only?: Values) => {
      for (let i = 0; i < a.length; i++) {
        if (only && only[i] <= 0.02 * recording.meta.weight) continue;
        reach[0] = Math.min(reach[0], a[i]);
        reach[1] = Math.max(reach[1], a[i]);
        reach[2] = Math.min(reach[2], b[i]);
        reach[3] = Math.max(reach[3], b[i]);
      }
    };
    see(x, y);
    if (this.second) see(...this.second);
    for (const [fz, px, py] of this.prints) see(px, py, fz);
    const room = 0.06 * Math.max(reach[1] - reach[0], reach[3] - reach[2], 0.02);
    const perPixel = Math.max((reach[1] - reach[0] + 2 * room) / (box.right - box.left), (reach[3] - reach[2] + 2 * room) / (box.bottom - box.top));
    const halfX = perPixel * (box.right - box.left) / 2, halfY = perPixel * (box.bottom - box.top) / 2, cx = (reach[0] + reach[1]) / 2, cy = (reach[2] + reach[3]) / 2;
    const { X, Y } = (this.scale = frame(pen, ink, box, [cx - halfX, cx + halfX], [cy - halfY, cy + halfY], { x: "x (m)", y: "y (m)" }));
    pen.save();
    pen.beginPath();
    pen.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    pen.clip();
    pen.fillStyle = ink.green;
    pen.globalAlpha = 0.12;
    const step = Math.max(1, Math.floor(n / 700));
    for (const [fz, px, py] of this.prints) for (let i = 0; i < n; i += step) if (fz[i] > 0.02 * recording.meta.weight) pen.fillRect(X(px[i]) - 1.5, Y(py[i]) - 1.5, 3, 3);
    pen.globalAlpha = 1;
    pen.strokeStyle = ink.blue;
    pen.lineWidth = 2;
    pen.lineJoin = "round";
    pen.beginPath();
    for (let i = 0; i < n; i += Math.max(1, Math.floor(n / 2000))) pen.lineTo(X(x[i]), Y(y[i]));
    pen.stroke();
    if (this.second) {
      const [a, b] = this.second;
      pen.setLineDash([7, 4]);
      pen.strokeStyle = ink.purple;
      pen.beginPath();
      for (let i = 0; i < a.length; i += Math.max(1, Math.floor(a.length / 2000))) pen.lineTo(X(a[i]), Y(b[i]));
      pen.stroke();
      pen.setLineDash([]);
      pen.strokeStyle = ink.blue;
    }
    pen.fillStyle = ink.panel;
    pen.beginPath();
    pen.arc(X(x[0]), Y(y[0]), 4, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
    pen.restore();
    this.seek(desk.state.t);
  }
}
