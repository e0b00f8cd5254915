// Time along a drawing of rows, such as a heat map: seconds below the rows, playhead, and the time of a click.
import { font, ticks, type Pen } from "./board";
import type { Desk } from "../panel";

export class TimeRows {
  private readonly head: HTMLElement | null;

  /** `left` and `right` are the margins beside the rows, px. */
  constructor(
    private readonly host: HTMLElement,
    private readonly desk: Desk,
    private readonly left: number,
    private readonly right = 0,
  ) {
    this.head = host.querySelector<HTMLElement>(".playhead");
  }

  /** Draws the seconds below the rows, at the height y. */
  axis(pen: Pen, width: number, y: number): void {
    const { ink, state } = this.desk;
    const [from, to] = state.span;
    const marks = ticks(from, to, width / 64);
    pen.font = font(11);
    pen.fillStyle = ink.muted;
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const [i, t] of marks.at.entries()) {
      const x = this.left + ((t - from) / (to - from)) * width;
      const text = marks.text(t) + (i === marks.at.length - 1 ? " s" : "");
      const half = pen.measureText(text).width / 2;
      pen.fillText(text, Math.min(Math.max(x, this.left + half), this.left + width - half), y);
    }
    this.seek(state.t);
  }

  /** Moves the playhead to a time, or hides it if the time is outside the span. */
  seek(t: number): void {
    if (!this.head) return;
    const [from, to] = this.desk.state.span;
    const x = (t - from) / (to - from);
    this.head.style.display = x >= 0 && x <= 1 ? "" : "none";
    this.head.style.transform = `translateX(${this.left + x * (this.host.clientWidth - this.left - this.right)}px)`;
  }

  /** Time of a click; null for a click beside the rows. */
  timeAt(e: MouseEvent): number | null {
    const r = this.host.getBoundingClientRect();
    const x = (e.clientX - r.left - this.left) / (r.width - this.left - this.right);
    const [from, to] = this.desk.state.span;
    return x >= 0 && x <= 1 ? from + x * (to - from) : null;
  }
}
