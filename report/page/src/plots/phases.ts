// Plot of the first harmonics in the limit cycle: amplitude of each joint, and lag behind the first oscillating joint.
import { Board, frame, type Box, type Pen, type Scale } from "./board";
import { element, leaveOut } from "../dom";
import { keys } from "../keyline";
import type { Desk, Panel } from "../panel";

const low = -Math.PI / 2 - 0.25; // lower end of the axis of the lag, rad; the frequent lag pi is far from the ends
const wrap = (a: number): number => a - 2 * Math.PI * Math.floor((a - low) / (2 * Math.PI));

/** A lag shifted by whole turns next to another, so that similar lags are never at opposite ends of the axis. */
const beside = (lag: number, other: number): number => lag - 2 * Math.PI * Math.round((lag - other) / (2 * Math.PI));

/** Lags of set point and angle, shifted next to each other, with their mean within the axis. */
function pair(setpoint: number, angle: number): [number, number] {
  const middle = (setpoint + beside(angle, setpoint)) / 2;
  return [beside(setpoint, wrap(middle)), beside(angle, wrap(middle))];
}

/** Horizontal position of a joint, vertical position of a lag, and radius of the largest disc, px. */
interface Place extends Scale {
  most: number;
}

export class Phases implements Panel {
  private readonly board: Board | null = null;
  private readonly widest: number;
  private readonly reference: number;

  constructor(private readonly desk: Desk) {
    const { phases, joints, cycle } = desk.recording.meta;
    this.widest = Math.max(...phases.map((p) => p.setpoint[0]), 1e-9);
    this.reference = Math.max(
      phases.findIndex((p) => p.setpoint[0] > 0.2 * this.widest),
      0,
    );
    if (!phases.length || !phases.some((p) => p.setpoint[0] > 1e-6)) {
      leaveOut(element("phase"), cycle ? "no joint has an oscillating set point." : "no limit cycle was found.");
      return;
    }
    element("phase-note").textContent = `behind ${joints[this.reference].name}`;
    this.board = new Board(element("phase"), "Phase lag of every joint", (pen, width, height) =>
      this.draw(pen, width, height),
    );
    keys("phase-key", [
      ["dotk", "--sky", "set point"],
      ["ring", "--vermillion", "angle"],
      ["square", "--purple", desk.ghost?.recording.meta.cycle ? `angle, ${desk.ghost.label}` : ""],
    ]);
    element("phase-key").append("area: amplitude");
  }

  paint(): void {
    this.board?.paint();
  }
  choose(): void {
    this.board?.paint();
  }

  private axes(pen: Pen, box: Box): Scale {
    const { ink, recording } = this.desk;
    const n = recording.meta.phases.length;
    const every = [1, 2, 5, 10, 20, 50].find((k) => (k * (box.right - box.left)) / n > 22) ?? 100;
    const quarters = ["−π/2", "0", "π/2", "π"];
    const lags = {
      at: quarters.map((_, k) => ((k - 1) * Math.PI) / 2),
      text: (v: number) => quarters[Math.round(v / (Math.PI / 2)) + 1],
    };
    const joints = { at: Array.from({ length: Math.ceil(n / every) }, (_, k) => k * every), text: String };
    const names = { x: "joint number", y: "lag (rad)" };
    return frame(pen, ink, box, [-0.5, n - 0.5], [low, low + 2 * Math.PI], names, { x: joints, y: lags });
  }

  private draw(pen: Pen, width: number, height: number): void {
    const n = this.desk.recording.meta.phases.length;
    const box: Box = { left: 52, right: width - 8, top: 8, bottom: height - 44 };
    const place: Place = {
      ...this.axes(pen, box),
      most: Math.max(2.5, Math.min(9, ((box.right - box.left) / n) * 0.46)),
    };
    this.squares(pen, place);
    this.discs(pen, place);
  }

  // Draws a square for the angle of each joint in the second run.
  private squares(pen: Pen, { X, Y, most }: Place): void {
    const { ghost, ink, recording } = this.desk;
    const theirs = ghost?.recording.meta.phases ?? [];
    const begin = theirs[ghost?.number("joint", this.reference) ?? -1]?.setpoint[1];
    recording.meta.phases.forEach((_, j) => {
      const at = theirs[ghost?.number("joint", j) ?? -1]?.angle;
      if (!at || begin === undefined || at[0] < 0.02 * this.widest) return;
      const half = 0.9 * Math.max(2.2, most * Math.sqrt(Math.min(at[0] / this.widest, 1.5)));
      pen.strokeStyle = ink.purple;
      pen.lineWidth = 1.5;
      pen.strokeRect(X(j) - half, Y(wrap(begin - at[1])) - half, 2 * half, 2 * half);
    });
  }

  // Draws set points as filled discs, and angles as rings. A joint without oscillation has a dash.
  private discs(pen: Pen, { X, Y, most }: Place): void {
    const { ink, recording, state } = this.desk;
    const { phases } = recording.meta;
    const zero = phases[this.reference].setpoint[1];
    const disc = (j: number, lag: number, amplitude: number) => {
      pen.beginPath();
      pen.arc(X(j), Y(lag), Math.max(2.2, most * Math.sqrt(amplitude / this.widest)), 0, 2 * Math.PI);
    };
    phases.forEach(({ setpoint: [A, a], angle: [B, b] }, j) => {
      const chosen = j === state.joint;
      if (A < 0.02 * this.widest) {
        pen.fillStyle = chosen ? ink.accent : ink.line;
        pen.fillRect(X(j) - 2.5, Y(0) - 0.75, 5, 1.5);
        return;
      }
      pen.fillStyle = chosen ? ink.blue : ink.sky;
      pen.globalAlpha = chosen ? 1 : 0.75;
      const [commanded, reached] = pair(zero - a, zero - b);
      disc(j, commanded, A);
      pen.fill();
      pen.globalAlpha = 1;
      pen.strokeStyle = ink.vermillion;
      pen.lineWidth = 1.5;
      disc(j, reached, Math.min(B, 1.5 * this.widest));
      pen.stroke();
    });
  }
}
