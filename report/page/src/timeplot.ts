// Curves over time with a playhead: a click sets the time, a drag zooms all plots, a double click shows the whole run.
import uPlot from "uplot";
import { font } from "./board";
import type { Values } from "./channels";
import type { Desk, Span } from "./panel";

type Side = "left" | "right";

export interface Curve {
  values: Values;
  label: string;
  colour: string;
  axis: Side;
  width?: number;
  dash?: number[];
}

export interface Level {
  value: number;
  axis: Side;
  colour: string;
  dash?: number[];
}

export interface Plot {
  label: string;
  curves: Curve[];
  left: { name: string; colour?: string };
  right?: { name: string; colour?: string };
  levels?: Level[];
  bands?: Span[];
  tubes?: Tube[];
}

/** How far a curve may be away from another. */
export interface Tube {
  around: Values;
  by: number;
  axis: Side;
  colour: string;
}

/** A curve of the second run, in the colour of the first one's. */
export const second = (values: Values, label: string, colour: string, axis: Side): Curve => ({ values, label, colour, axis, width: 1.5, dash: [7, 4] });

export class TimePlot {
  private readonly plot: uPlot;
  private readonly head = document.createElement("div");
  private readonly observer = new ResizeObserver(() => this.fit());

  constructor(private readonly host: HTMLElement, private readonly desk: Desk, what: Plot) {
    const { ink, recording } = desk, small = font(11), [left, right] = ranges(what);
    this.head.className = "playhead";
    const axis = (scale: Side, name: string, colour?: string): uPlot.Axis => ({
      scale, side: scale === "left" ? 3 : 1, stroke: colour ?? ink.muted, font: small, size: 46, label: name, labelFont: font(11.5), labelSize: 18, labelGap: 0, gap: 5,
      grid: { show: scale === "left", stroke: ink.grid, width: 1 }, ticks: { show: false }, space: 28, values: (_, at) => at.map((v) => String(+v.toFixed(6)).replace("-", "−")),
    });
    const bounds = host.getBoundingClientRect();
    this.plot = new uPlot({
      width: Math.max(bounds.width, 40), height: Math.max(bounds.height, 40), legend: { show: false }, padding: [8, what.right ? 0 : 16, 0, 0],
      scales: { x: { time: false, range: () => [...desk.state.span] as Span }, left: { range: () => left }, ...(what.right ? { right: { range: () => right } } : {}) },
      cursor: { drag: { x: true, y: false, setScale: false }, points: { show: false }, y: false, x: true },
      axes: [
        { stroke: ink.muted, font: small, grid: { stroke: ink.grid, width: 1 }, ticks: { show: false }, size: 24, gap: 5, values: (_, at) => at.map((v, i) => `${+v.toFixed(6)}${i === at.length - 1 ? " s" : ""}`) },
        axis("left", what.left.name, what.left.colour), ...(what.right ? [axis("right", what.right.name, what.right.colour)] : []),
      ],
      series: [{}, ...what.curves.map((c): uPlot.Series => ({ label: c.label, scale: c.axis, stroke: c.colour, width: c.width ?? 1.5, dash: c.dash, points: { show: false } }))],
      hooks: {
        drawClear: [(u) => {
          this.bands(u, what.bands ?? []);
          this.tubes(u, what.tubes ?? []);
        }],
        draw: [(u) => {
          this.levels(u, what.levels ?? []);
          this.mark(u, desk.state.t);
        }],
        setSelect: [(u) => {
          if (u.select.width > 8) desk.zoom([u.posToVal(u.select.left, "x"), u.posToVal(u.select.left + u.select.width, "x")]);
          if (u.select.width > 0) u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        }],
      },
    }, [recording.times as unknown as number[], ...what.curves.map((c) => gaps(c.values))], host);
    host.setAttribute("role", "img");
    host.setAttribute("aria-label", what.label);
    this.plot.over.append(this.head);
    this.observer.observe(host);
    this.plot.over.addEventListener("click", (e) => { if (this.plot.select.width < 4) desk.goTo(this.plot.posToVal(e.offsetX, "x")); });
    this.plot.over.addEventListener("dblclick", () => desk.zoom(null));
  }

  zoom(): void {
    const [min, max] = this.desk.state.span;
    this.plot.setScale("x", { min, max });
  }

  seek(t: number): void { this.mark(this.plot, t); }

  destroy(): void {
    this.observer.disconnect();
    this.plot.destroy();
  }

  private fit(): void {
    const { width, height } = this.host.getBoundingClientRect();
    if (width < 10 || height < 10 || (width === this.plot.width && height === this.plot.height)) return;
    this.plot.setSize({ width, height });
  }

  private mark(u: uPlot, t: number): void {
    const [from, to] = this.desk.state.span;
    this.head.style.display = t >= from && t <= to ? "" : "none";
    this.head.style.transform = `translateX(${u.valToPos(t, "x")}px)`;
  }

  private bands(u: uPlot, bands: Span[]): void {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.fillStyle = this.desk.ink.band;
    for (const [from, to] of bands) {
      const x = u.valToPos(from, "x", true);
      ctx.fillRect(x, bbox.top, Math.max(u.valToPos(to, "x", true) - x, 1.5), bbox.height);
    }
    ctx.restore();
  }

  private tubes(u: uPlot, tubes: Tube[]): void {
    const { ctx, bbox } = u, { times } = this.desk.recording;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    for (const { around, by, axis, colour } of tubes) {
      const shape = new Path2D(), edge = (i: number, sign: number) => shape.lineTo(u.valToPos(times[i], "x", true), u.valToPos(around[i] + sign * by, axis, true));
      for (let i = 0; i < times.length; i++) edge(i, 1);
      for (let i = times.length - 1; i >= 0; i--) edge(i, -1);
      ctx.fillStyle = colour;
      ctx.globalAlpha = 0.18;
      ctx.fill(shape);
    }
    ctx.restore();
  }

  private levels(u: uPlot, levels: Level[]): void {
    const { ctx, bbox } = u, ratio = window.devicePixelRatio || 1;
    ctx.save();
    ctx.lineWidth = ratio;
    for (const { value, axis, colour, dash } of levels) {
      const y = u.valToPos(value, axis, true);
      ctx.strokeStyle = colour;
      ctx.setLineDash((dash ?? []).map((d) => d * ratio));
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    }
    ctx.restore();
  }
}

/** As uPlot takes it: a line ends where a value is not known. */
function gaps(values: Values): number[] {
  return (values.some(Number.isNaN) ? Array.from(values, (v) => (Number.isNaN(v) ? null : v)) : values) as unknown as number[];
}

/** Of both axes, with their zeros on one line as report/plot/axes.h has it: the same share of each lies below zero. */
function ranges({ curves, levels = [] }: Plot): [Span, Span] {
  const reach = (side: Side): Span => {
    let low = 0, high = 0;
    for (const c of curves) if (c.axis === side) for (const v of c.values) { if (v < low) low = v; if (v > high) high = v; }
    for (const l of levels) if (l.axis === side) { low = Math.min(low, l.value); high = Math.max(high, l.value); }
    const room = 0.06 * (high - low || 1);
    return [low - room, high + room];
  };
  const both = [reach("left"), reach("right")], used = both.filter((_, i) => i === 0 || curves.some((c) => c.axis === "right"));
  const below = Math.max(...used.map(([a, b]) => -a / (b - a))), above = Math.max(...used.map(([a, b]) => b / (b - a))), share = below / (below + above);
  const fit = ([a, b]: Span): Span => {
    const whole = Math.max(share > 0 ? -a / share : 0, share < 1 ? b / (1 - share) : 0);
    return [-whole * share, whole * (1 - share)];
  };
  return [fit(both[0]), fit(both[1])];
}
