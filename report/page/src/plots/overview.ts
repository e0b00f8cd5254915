// Background of the time slider: largest load of all joints, judged window, times of failed checks.
import { Board, type Pen } from "./board";
import { css, load } from "../colour";
import { element } from "../dom";
import { keys } from "../keyline";
import type { Desk, Panel } from "../panel";

export class Overview implements Panel {
  private readonly board: Board;

  constructor(private readonly desk: Desk) {
    this.board = new Board(element("overview"), "Largest load of any joint over time", (pen, width, height) =>
      this.draw(pen, width, height),
    );
  }

  paint(): void {
    const { joints, verdict } = this.desk.recording.meta;
    keys(
      "overview-key",
      joints.length && verdict.checks.length
        ? [
            ["", "--orange", "largest load of any joint"],
            ["", "--line", "judged window"],
            ["", "--fail", verdict.checks.some((c) => c.status === "fail" && c.from !== null) ? "a check fails" : ""],
          ]
        : [],
    );
    this.board.paint();
  }

  private draw(pen: Pen, width: number, height: number): void {
    const { recording, loads, ink } = this.desk;
    const { window, checks } = recording.meta.verdict;
    const end = recording.end || 1;
    const X = (t: number) => (t / end) * width;
    const foot = height - 5;
    const top = 2;
    pen.fillStyle = ink.track;
    pen.fillRect(0, top, width, foot - top);
    for (let x = 0; x < width; x++) {
      const from = recording.row((x / width) * end);
      const to = Math.max(from + 1, recording.row(((x + 1) / width) * end));
      let most = 0;
      for (let i = from; i < to; i++) most = Math.max(most, loads.worst[i]);
      const tall = Math.max(1, most * (foot - top));
      pen.fillStyle = css(load(ink.theme, Math.max(most, 0.34)));
      pen.fillRect(x, foot - tall, 1, tall);
    }
    pen.fillStyle = ink.veil;
    pen.fillRect(0, top, X(window.from), foot - top);
    pen.fillRect(X(window.to), top, width - X(window.to), foot - top);
    pen.fillStyle = ink.line;
    pen.fillRect(X(window.from), height - 3, X(window.to) - X(window.from), 2);
    pen.fillStyle = ink.fail;
    for (const { status, from, to } of checks) {
      if (status === "fail" && from !== null) {
        pen.fillRect(X(from) - 1, height - 4, Math.max(3, X(to ?? from) - X(from)), 4);
      }
    }
  }
}
