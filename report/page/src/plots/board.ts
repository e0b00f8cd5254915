// Canvas that fills its parent, and its common parts: ticks, axes, frame.
import type { Ink } from "../colour";
import type { Values } from "../data/channels";
import { fixed } from "../data/numbers";
import type { Span } from "../data/recording";

export type Pen = CanvasRenderingContext2D;
type Draw = (pen: Pen, width: number, height: number) => void;

export const font = (px: number, weight = 400): string =>
  `${weight} ${px}px ${getComputedStyle(document.body).fontFamily}`;

export class Board {
  private readonly canvas = document.createElement("canvas");
  private painted = { width: 0, height: 0 };

  constructor(
    private readonly host: HTMLElement,
    label: string,
    private readonly draw: Draw,
  ) {
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", label);
    host.prepend(this.canvas);
    new ResizeObserver(() => {
      const { width, height } = host.getBoundingClientRect();
      if (width !== this.painted.width || height !== this.painted.height) this.paint();
    }).observe(host);
  }

  paint(): void {
    const { width, height } = this.host.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const pen = this.canvas.getContext("2d");
    if (width < 2 || height < 2 || !pen) return;
    this.painted = { width, height };
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    pen.scale(ratio, ratio);
    this.draw(pen, width, height);
  }
}

interface Ticks {
  at: number[];
  text: (v: number) => string;
}

/** About `count` ticks at a distance of 1, 2 or 5 times a power of ten. */
export function ticks(lo: number, hi: number, count: number): Ticks {
  const raw = Math.max(hi - lo, 1e-12) / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find((m) => m * power >= raw * (1 - 1e-9)) ?? 10) * power;
  const first = Math.ceil(lo / step - 1e-9);
  const at: number[] = [];
  for (let k = first; k * step <= hi + 1e-9 * step; k++) at.push(k * step);
  const decimals = Math.min(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), 6);
  return { at, text: (v) => fixed(v, decimals) };
}

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export interface Scale {
  X: (v: number) => number;
  Y: (v: number) => number;
}

/**
 * Draws the grid, numbers and names of two axes. Returns the functions from values to pixels. `marks` replaces ticks of
 * an axis.
 */
export function frame(
  pen: Pen,
  ink: Ink,
  box: Box,
  x: Span,
  y: Span,
  names: { x: string; y: string },
  marks: { x?: Ticks; y?: Ticks } = {},
): Scale {
  const X = (v: number) => box.left + ((v - x[0]) / (x[1] - x[0])) * (box.right - box.left);
  const Y = (v: number) => box.bottom - ((v - y[0]) / (y[1] - y[0])) * (box.bottom - box.top);
  const across = marks.x ?? ticks(x[0], x[1], Math.max(2, (box.right - box.left) / 72));
  const up = marks.y ?? ticks(y[0], y[1], Math.max(2, (box.bottom - box.top) / 38));
  pen.font = font(11);
  pen.fillStyle = ink.muted;
  pen.strokeStyle = ink.grid;
  pen.lineWidth = 1;
  pen.textAlign = "center";
  pen.textBaseline = "top";
  for (const v of across.at) {
    line(pen, X(v), box.top, X(v), box.bottom);
    pen.fillText(across.text(v), X(v), box.bottom + 6);
  }
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (const v of up.at) {
    line(pen, box.left, Y(v), box.right, Y(v));
    pen.fillText(up.text(v), box.left - 7, Y(v));
  }
  axisName(pen, ink, (box.left + box.right) / 2, box.bottom + 24, names.x);
  pen.save();
  pen.translate(2, (box.top + box.bottom) / 2);
  pen.rotate(-Math.PI / 2);
  axisName(pen, ink, 0, 0, names.y);
  pen.restore();
  return { X, Y };
}

function axisName(pen: Pen, ink: Ink, x: number, y: number, name: string): void {
  pen.font = font(11.5);
  pen.fillStyle = ink.ink2;
  pen.textAlign = "center";
  pen.textBaseline = "top";
  pen.fillText(name, x, y);
}

export function line(pen: Pen, x0: number, y0: number, x1: number, y1: number): void {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

/** Draws the curve through the points of two channels from row `from` on, of which every `step`-th counts. */
export function trace(pen: Pen, { X, Y }: Scale, x: Values, y: Values, from = 0, step = 1): void {
  pen.beginPath();
  for (let i = from; i < x.length; i += step) pen.lineTo(X(x[i]), Y(y[i]));
  pen.stroke();
}

/** Calls `draw`, clipped to a box. */
export function clipped(pen: Pen, box: Box, draw: () => void): void {
  pen.save();
  pen.beginPath();
  pen.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  pen.clip();
  draw();
  pen.restore();
}

/** A text cut to a width, with an ellipsis. */
export function fitted(pen: Pen, text: string, width: number): string {
  if (pen.measureText(text).width <= width) return text;
  let n = text.length;
  while (n > 1 && pen.measureText(`${text.slice(0, n)}…`).width > width) n--;
  return `${text.slice(0, n)}…`;
}
