// Plot of the footfalls: load of each foot over time, and the duty factor in the judged window. A darker colour means a
// larger load.
import { Board, fitted, font, type Pen } from "./board";
import type { Values } from "../data/channels";
import { element, leaveOut } from "../dom";
import type { Meta } from "../data/format";
import { keys } from "../keyline";
import type { Desk, Panel } from "../panel";
import { leastLoad, many } from "../data/places";
import type { Recording } from "../data/recording";
import { TimeRows } from "./time_rows";

const left = 116;
const right = 46;
const foot = 22;

interface Foot {
  name: string;
  load: Values;
  duty: number;
  number: number;
}

export class Footfalls implements Panel {
  private readonly board: Board | null = null;
  private readonly host = element("foot");
  private readonly time: TimeRows;
  private readonly feet: Foot[];
  private readonly on: number;
  private readonly most: number;

  constructor(private readonly desk: Desk) {
    const { recording, ghost } = desk;
    this.on = leastLoad(recording.meta);
    if (many(recording.meta)) {
      element("foot-note").textContent = "load above a fifth of the mean load of a foot; right: duty factor";
    }
    this.feet = feetOf(recording, this.on);
    this.most = Math.max(1e-9, ...this.feet.map((f) => f.load.reduce((a, b) => Math.max(a, b), 0)));
    this.time = new TimeRows(this.host, desk, left, right);
    if (!this.feet.length) {
      leaveOut(this.host, lacking(recording.meta));
      return;
    }
    if (ghost) {
      keys("foot-key", [
        ["band", "--green", ghost.overlay.labels[0]],
        ["band", "--purple", `${ghost.label}, below`],
      ]);
    }
    const feet = this.feet.length;
    this.host.style.height = `${foot + Math.max(Math.min(220, 60 * feet), Math.min(330, 26 * feet))}px`;
    this.board = new Board(this.host, "Load of each foot over time", (pen, width, height) =>
      this.draw(pen, width, height),
    );
    this.host.addEventListener("click", (e) => this.click(e));
  }

  paint(): void {
    this.board?.paint();
  }
  zoom(): void {
    this.board?.paint();
  }

  seek(t: number): void {
    if (this.board) this.time.seek(t);
  }

  private click(e: MouseEvent): void {
    const t = this.time.timeAt(e);
    if (t !== null) this.desk.goTo(t);
  }

  private draw(pen: Pen, fullWidth: number, fullHeight: number): void {
    const { feet, desk } = this;
    const { recording, state } = desk;
    const width = Math.floor(fullWidth - left - right);
    const height = fullHeight - foot;
    const each = height / feet.length;
    const edges = recording.columns(state.span, width);
    let last = -99;
    feet.forEach((one, r) => {
      const middle = r * each + each / 2;
      this.row(pen, one, edges, r * each, each);
      if (middle - last < 11.5) return;
      last = middle;
      this.name(pen, one, fullWidth, middle);
    });
    this.time.axis(pen, width, height + 7);
  }

  // Draws the row of a foot. For two runs, the lower third of the row is the second run.
  private row(pen: Pen, { load, number }: Foot, edges: number[], y: number, each: number): void {
    const { ink, ghost } = this.desk;
    const gap = Math.min(5, each * 0.16);
    const top = y + gap;
    const tall = each - 2 * gap;
    const upper = ghost ? 0.62 * tall : tall;
    const second = ghost?.values(`foot.${number}.fz`) ?? null;
    pen.fillStyle = ink.track;
    pen.fillRect(left, top, edges.length - 1, tall);
    pen.fillStyle = ink.green;
    this.blocks(pen, load, this.on, edges, top, upper);
    if (second) {
      pen.fillStyle = ink.purple;
      this.blocks(pen, second, leastLoad(ghost!.recording.meta), edges, top + upper + 1, tall - upper - 1);
    }
  }

  // Fills each column of pixels in which the load exceeds `on`.
  private blocks(pen: Pen, load: Values, on: number, edges: number[], y: number, height: number): void {
    for (let x = 0; x + 1 < edges.length; x++) {
      let held = 0;
      for (let i = edges[x], end = Math.max(edges[x] + 1, edges[x + 1]); i < end; i++) {
        if (load[i] > held) held = load[i];
      }
      if (held <= on) continue;
      pen.globalAlpha = 0.35 + 0.65 * Math.min(1, held / (0.6 * this.most));
      pen.fillRect(left + x, y, 1, height);
    }
    pen.globalAlpha = 1;
  }

  private name(pen: Pen, { name, duty }: Foot, width: number, middle: number): void {
    pen.font = font(11);
    pen.textBaseline = "middle";
    pen.fillStyle = this.desk.ink.ink2;
    pen.textAlign = "right";
    pen.fillText(fitted(pen, name, left - 12), left - 8, Math.max(middle, 6));
    pen.fillText(`${Math.round(100 * duty)} %`, width - 2, Math.max(middle, 6));
  }
}

/** Feet with a recorded load. A foot is on the ground if its load exceeds `on`, N. */
function feetOf(recording: Recording, on: number): Foot[] {
  const { meta, judged } = recording;
  return meta.feet.flatMap(({ title: name }, n) => {
    const load = recording.find(`foot.${n}.fz`);
    if (!load) return [];
    let rows = 0;
    for (let i = judged; i < load.length; i++) rows += load[i] > on ? 1 : 0;
    return [{ name, number: n, load, duty: rows / Math.max(1, load.length - judged) }];
  });
}

/** Reason for which the plot of the footfalls is left out. */
function lacking({ ground, contacts }: Meta): string {
  if (ground.kind === "none") return "there is no ground.";
  return contacts.length
    ? "no foot carries load, or the recording has no contacts (trace.columns)."
    : "nothing of the robot touches the ground.";
}
