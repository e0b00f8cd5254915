// Plot of the path of the centre of mass, seen from above, with the footprints.
import { Board, clipped, frame, trace, type Box, type Pen, type Scale } from "./board";
import type { Values } from "../data/channels";
import { element, leaveOut } from "../dom";
import { keys } from "../keyline";
import type { Desk, Panel } from "../panel";
import type { Span } from "../data/recording";
import { leastLoad } from "../data/places";

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
    keys("path-key", [
      ["", "--blue", "centre of mass"],
      ["ring", "--blue", "start"],
      ["dotk", "--green", this.prints.length ? "feet on the ground" : ""],
      ["dash", "--purple", this.second ? `centre of mass, ${desk.ghost!.label}` : ""],
    ]);
    this.board = new Board(element("path"), "Path of the centre of mass, from above", (pen, width, height) =>
      this.draw(pen, width, height),
    );
  }

  // Path of the second run at the rows of that run, independent of the time shown; null if it is not recorded.
  private get second(): [Values, Values] | null {
    const x = this.desk.ghost?.recording.find("com.x");
    const y = this.desk.ghost?.recording.find("com.y");
    return x && y ? [x, y] : null;
  }

  paint(): void {
    this.board?.paint();
  }

  seek(t: number): void {
    if (!this.scale) return;
    const { recording } = this.desk;
    const { X, Y } = this.scale;
    this.dot.style.transform = `translate(${X(recording.at(this.x, t))}px,${Y(recording.at(this.y, t))}px)`;
  }

  // Least and largest x, and least and largest y, of paths and footprints, m.
  private reach(): [number, number, number, number] {
    const on = leastLoad(this.desk.recording.meta);
    const reach: [number, number, number, number] = [Infinity, -Infinity, Infinity, -Infinity];
    const see = (a: Values, b: Values, only?: Values) => {
      for (let i = 0; i < a.length; i++) {
        if (only && only[i] <= on) continue;
        reach[0] = Math.min(reach[0], a[i]);
        reach[1] = Math.max(reach[1], a[i]);
        reach[2] = Math.min(reach[2], b[i]);
        reach[3] = Math.max(reach[3], b[i]);
      }
    };
    see(this.x, this.y);
    if (this.second) see(...this.second);
    for (const [fz, px, py] of this.prints) see(px, py, fz);
    return reach;
  }

  private draw(pen: Pen, width: number, height: number): void {
    const { desk } = this;
    const box: Box = { left: 58, right: width - 14, top: 10, bottom: height - 44 };
    const { x, y } = this.ranges(box);
    this.scale = frame(pen, desk.ink, box, x, y, { x: "x (m)", y: "y (m)" });
    clipped(pen, box, () => {
      this.footprints(pen);
      this.paths(pen);
      this.start(pen);
    });
    this.seek(desk.state.t);
  }

  // Ranges of the axes around all paths. Both axes have the same scale.
  private ranges(box: Box): { x: Span; y: Span } {
    const [x0, x1, y0, y1] = this.reach();
    const room = 0.06 * Math.max(x1 - x0, y1 - y0, 0.02);
    const perPixel = Math.max(
      (x1 - x0 + 2 * room) / (box.right - box.left),
      (y1 - y0 + 2 * room) / (box.bottom - box.top),
    );
    const around = (middle: number, pixels: number): Span => {
      const half = (perPixel * pixels) / 2;
      return [middle - half, middle + half];
    };
    return {
      x: around((x0 + x1) / 2, box.right - box.left),
      y: around((y0 + y1) / 2, box.bottom - box.top),
    };
  }

  private footprints(pen: Pen): void {
    const { ink, recording } = this.desk;
    const { X, Y } = this.scale!;
    const step = Math.max(1, Math.floor(recording.rows / 700));
    const on = leastLoad(recording.meta);
    pen.fillStyle = ink.green;
    pen.globalAlpha = 0.12;
    for (const [fz, px, py] of this.prints) {
      for (let i = 0; i < recording.rows; i += step) {
        if (fz[i] > on) pen.fillRect(X(px[i]) - 1.5, Y(py[i]) - 1.5, 3, 3);
      }
    }
    pen.globalAlpha = 1;
  }

  private paths(pen: Pen): void {
    const { ink } = this.desk;
    const path = (x: Values, y: Values) => trace(pen, this.scale!, x, y, 0, Math.max(1, Math.floor(x.length / 2000)));
    pen.strokeStyle = ink.blue;
    pen.lineWidth = 2;
    pen.lineJoin = "round";
    path(this.x, this.y);
    if (this.second) {
      pen.setLineDash([7, 4]);
      pen.strokeStyle = ink.purple;
      path(...this.second);
      pen.setLineDash([]);
    }
  }

  private start(pen: Pen): void {
    const { ink } = this.desk;
    const { X, Y } = this.scale!;
    pen.strokeStyle = ink.blue;
    pen.fillStyle = ink.panel;
    pen.beginPath();
    pen.arc(X(this.x[0]), Y(this.y[0]), 4, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  }
}
