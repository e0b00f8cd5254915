// When each foot carries load, darker: more; beside it the duty factor of the judged window.
import { Board, fitted, font, timeAxis, type Pen } from "./board";
import type { Values } from "./channels";
import { element, leaveOut } from "./dom";
import { keys } from "./keyline";
import type { Desk, Panel } from "./panel";

const left = 116, right = 46, foot = 22, threshold = 0.02; // of the weight

interface Foot {
  name: string;
  load: Values;
  duty: number;
  number: number;
}

export class Footfalls implements Panel {
  private readonly board: Board | null = null;
  private readonly host = element("foot");
  private readonly head: HTMLElement | null;
  private readonly feet: Foot[];
  private readonly on: number;
  private readonly most: number;

  constructor(private readonly desk: Desk) {
    const { recording } = desk, from = recording.judged;
    this.on = threshold * recording.meta.weight;
    this.feet = recording.meta.feet.flatMap(({ title: name }, n) => {
      const load = recording.find(`foot.${n}.fz`);
      if (!load) return [];
      let rows = 0;
      for (let i = from; i < load.length; i++) rows += load[i] > this.on ? 1 : 0;
      return [{ name, number: n, load, duty: rows / Math.max(1, load.length - from) }];
    });
    this.most = Math.max(1e-9, ...this.feet.map((f) => f.load.reduce((a, b) => Math.max(a, b), 0)));
    this.head = this.host.querySelector<HTMLElement>(".playhead");
    if (!this.feet.length) {
      leaveOut(this.host, recording.meta.ground.kind === "none" ? "there is no ground." : recording.meta.contacts.length ? "no foot carries load, or the recording has no contacts (trace.columns)." : "nothing of the robot touches the ground.");
      return;
    }
    if (desk.ghost) keys("foot-key", [["band", "--green", desk.ghost.overlay.labels[0]], ["band", "--purple", `${desk.ghost.label}, below`]]);
    this.host.style.height = `${foot + Math.max(Math.min(220, 60 * this.feet.length), Math.min(330, this.feet.length * 26))}px`;
    this.board = new Board(this.host, "When each foot carries load", (pen, width, height) => this.draw(pen, width, height));
    this.host.addEventListener("click", (e) => {
      const r = this.host.getBoundingClientRect(), x = (e.clientX - r.left - left) / (r.width - left - right), [a, b] = desk.state.span;
      if (x >= 0 && x <= 1) desk.goTo(a + x * (b - a));
    });
  }

  paint(): void { this.board?.paint(); }
  zoom(): void { this.board?.paint(); }

  seek(t: number): void {
    if (!this.board || !this.head) return;
    const [from, to] = this.desk.state.span, x = (t - from) / (to - from);
    this.head.style.display = x >= 0 && x <= 1 ? "" : "none";
    this.head.style.transform = `translateX(${left + x * (this.host.clientWidth - left - right)}px)`;
  }

  private draw(pen: Pen, fullWidth: number, fullHeight: number): void {
    const { feet, desk } = this, { ink, recording, state } = desk, width = Math.floor(fullWidth - left - right), height = fullHeight - foot, each = height / feet.length, [from, to] = state.span;
    const edges = Array.from({ length: width + 1 }, (_, x) => recording.row(from + (to - from) * x / width));
    let last = -99;
    feet.forEach(({ name, load, duty, number }, r) => {
      const top = r * each, gap = Math.min(5, each * 0.16), middle = top + each / 2;
      // Two runs share a row: the second one has its lower third.
      const second = desk.ghost?.values(`foot.${number}.fz`) ?? null, tall = each - 2 * gap, upper = desk.ghost ? 0.62 * tall : tall;
      pen.fillStyle = ink.track;
      pen.fillRect(left, top + gap, width, tall);
      const blocks = (values: Values, colour: string, on: number, most: number, y: number, h: number) => {
        pen.fillStyle = colour;
        for (let x = 0; x < width; x++) {
          let held = 0;
          for (let i = edges[x], end = Math.max(edges[x] + 1, edges[x + 1]); i < end; i++) if (values[i] > held) held = values[i];
          if (held <= on) continue;
          pen.globalAlpha = 0.35 + 0.65 * Math.min(1, held / (0.6 * most));
          pen.fillRect(left + x, y, 1, h);
        }
        pen.globalAlpha = 1;
      };
      blocks(load, ink.green, this.on, this.most, top + gap, upper);
      if (second) blocks(second, ink.purple, threshold * desk.ghost!.recording.meta.weight, this.most, top + gap + upper + 1, tall - upper - 1);
      if (middle - last < 11.5) return;
      last = middle;
      pen.font = font(11);
      pen.textBaseline = "middle";
      pen.fillStyle = ink.ink2;
      pen.textAlign = "right";
      pen.fillText(fitted(pen, name, left - 12), left - 8, Math.max(middle, 6));
      pen.fillText(`${Math.round(100 * duty)} %`, fullWidth - 2, Math.max(middle, 6));
    });
    timeAxis(pen, ink, left, width, height + 7, state.span);
    this.seek(state.t);
  }
}
