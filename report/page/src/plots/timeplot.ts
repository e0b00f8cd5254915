// Plot of curves over time. A click sets the time, a drag selects the span of all plots over time, and a double click
// shows the whole run.
import uPlot from "uplot";
import { clipped, font } from "./board";
import type { Ink } from "../colour";
import type { Values } from "../data/channels";
import type { Desk } from "../panel";
import type { Span } from "../data/recording";

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

interface Plot {
  label: string;
  curves: Curve[];
  left: { name: string; colour?: string };
  right?: { name: string; colour?: string };
  levels?: Level[];
  bands?: Span[];
  tubes?: Tube[];
}

/** Band of tolerance around a curve. */
export interface Tube {
  around: Values;
  by: number;
  axis: Side;
  colour: string;
}

/** List with one curve, or an empty list without values. */
export const curve = (values: Values | null | undefined, look: Omit<Curve, "values">): Curve[] =>
  values ? [{ values, ...look }] : [];

/** List with the dashed curve of the second run, or an empty list without values. */
export const second = (values: Values | null | undefined, label: string, colour: string, axis: Side): Curve[] =>
  curve(values, { label, colour, axis, width: 1.5, dash: [7, 4] });

export class TimePlot {
  private readonly plot: uPlot;
  private readonly head = document.createElement("div");
  private readonly observer = new ResizeObserver(() => this.fit());

  constructor(
    private readonly host: HTMLElement,
    private readonly desk: Desk,
    what: Plot,
  ) {
    const { ink, recording } = desk;
    const [left, right] = ranges(what);
    this.head.className = "playhead";
    const bounds = host.getBoundingClientRect();
    this.plot = new uPlot(
      {
        width: Math.max(bounds.width, 40),
        height: Math.max(bounds.height, 40),
        legend: { show: false },
        padding: [8, what.right ? 0 : 16, 0, 0],
        scales: {
          x: { time: false, range: () => [...desk.state.span] as Span },
          left: { range: () => left },
          ...(what.right ? { right: { range: () => right } } : {}),
        },
        cursor: { drag: { x: true, y: false, setScale: false }, points: { show: false }, y: false, x: true },
        axes: [timeAxis(ink), axis(ink, "left", what.left), ...(what.right ? [axis(ink, "right", what.right)] : [])],
        series: [{}, ...what.curves.map(series)],
        hooks: this.hooks(what),
      },
      [recording.times as unknown as number[], ...what.curves.map((c) => gaps(c.values))],
      host,
    );
    host.setAttribute("role", "img");
    host.setAttribute("aria-label", what.label);
    this.plot.over.append(this.head);
    this.observer.observe(host);
    this.plot.over.addEventListener("click", (e) => {
      if (this.plot.select.width < 4) desk.goTo(this.plot.posToVal(e.offsetX, "x"));
    });
    this.plot.over.addEventListener("dblclick", () => desk.zoom(null));
  }

  private hooks({ bands = [], tubes = [], levels = [] }: Plot): uPlot.Hooks.Arrays {
    const { desk } = this;
    const below = (u: uPlot) => {
      const { left, top, width, height } = u.bbox;
      clipped(u.ctx, { left, right: left + width, top, bottom: top + height }, () => {
        this.changes(u);
        this.bands(u, bands);
        this.tubes(u, tubes);
      });
    };
    const above = (u: uPlot) => {
      this.levels(u, levels);
      this.mark(u, desk.state.t);
    };
    const select = (u: uPlot) => {
      const { left, width } = u.select;
      if (width > 8) desk.zoom([u.posToVal(left, "x"), u.posToVal(left + width, "x")]);
      if (width > 0) u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    };
    return { drawClear: [below], draw: [above], setSelect: [select] };
  }

  zoom(): void {
    const [min, max] = this.desk.state.span;
    this.plot.setScale("x", { min, max });
  }

  seek(t: number): void {
    this.mark(this.plot, t);
  }

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

  /** Shades the time after the first change of the run, and names each change at its time. */
  private changes(u: uPlot): void {
    const { changes = [] } = this.desk.recording.meta;
    if (changes.length === 0) return;
    const { ctx, bbox } = u;
    const ratio = window.devicePixelRatio || 1;
    const first = Math.max(u.valToPos(changes[0].t, "x", true), bbox.left);
    ctx.fillStyle = this.desk.ink.track;
    ctx.globalAlpha = 0.5;
    ctx.fillRect(first, bbox.top, bbox.left + bbox.width - first, bbox.height);
    ctx.globalAlpha = 1;
    ctx.fillStyle = this.desk.ink.muted;
    ctx.font = font(10 * ratio);
    ctx.textBaseline = "top";
    for (const [k, { t, text }] of changes.entries()) {
      const x = u.valToPos(t, "x", true);
      ctx.fillRect(x, bbox.top, ratio, bbox.height);
      ctx.fillText(text, Math.max(x, bbox.left) + 4 * ratio, bbox.top + (2 + 12 * (k % 3)) * ratio);
    }
  }

  private bands(u: uPlot, bands: Span[]): void {
    const { ctx, bbox } = u;
    ctx.fillStyle = this.desk.ink.band;
    for (const [from, to] of bands) {
      const x = u.valToPos(from, "x", true);
      ctx.fillRect(x, bbox.top, Math.max(u.valToPos(to, "x", true) - x, 1.5), bbox.height);
    }
  }

  private tubes(u: uPlot, tubes: Tube[]): void {
    const { ctx } = u;
    const { times } = this.desk.recording;
    for (const { around, by, axis, colour } of tubes) {
      const shape = new Path2D();
      const edge = (i: number, sign: number) =>
        shape.lineTo(u.valToPos(times[i], "x", true), u.valToPos(around[i] + sign * by, axis, true));
      for (let i = 0; i < times.length; i++) edge(i, 1);
      for (let i = times.length - 1; i >= 0; i--) edge(i, -1);
      ctx.fillStyle = colour;
      ctx.globalAlpha = 0.18;
      ctx.fill(shape);
    }
  }

  private levels(u: uPlot, levels: Level[]): void {
    const { ctx, bbox } = u;
    const ratio = window.devicePixelRatio || 1;
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

function timeAxis(ink: Ink): uPlot.Axis {
  return {
    stroke: ink.muted,
    font: font(11),
    grid: { stroke: ink.grid, width: 1 },
    ticks: { show: false },
    size: 24,
    gap: 5,
    values: (_, at) => at.map((v, i) => `${+v.toFixed(6)}${i === at.length - 1 ? " s" : ""}`),
  };
}

function axis(ink: Ink, scale: Side, { name, colour }: { name: string; colour?: string }): uPlot.Axis {
  return {
    scale,
    side: scale === "left" ? 3 : 1,
    stroke: colour ?? ink.muted,
    font: font(11),
    size: 46,
    label: name,
    labelFont: font(11.5),
    labelSize: 18,
    labelGap: 0,
    gap: 5,
    grid: { show: scale === "left", stroke: ink.grid, width: 1 },
    ticks: { show: false },
    space: 28,
    values: (_, at) => at.map((v) => String(+v.toFixed(6)).replace("-", "−")),
  };
}

const series = (c: Curve): uPlot.Series => ({
  label: c.label,
  scale: c.axis,
  stroke: c.colour,
  width: c.width ?? 1.5,
  dash: c.dash,
  points: { show: false },
});

/** Values with null in place of NaN, because uPlot interrupts a curve at null. */
function gaps(values: Values): number[] {
  return (values.some(Number.isNaN)
    ? Array.from(values, (v) => (Number.isNaN(v) ? null : v))
    : values) as unknown as number[];
}

/** Ranges of both axes. The same share of each range is below zero, so that the zeros of the axes coincide. */
function ranges({ curves, levels = [] }: Plot): [Span, Span] {
  const reach = (side: Side): Span => {
    let low = 0;
    let high = 0;
    for (const c of curves) {
      if (c.axis === side) {
        for (const v of c.values) {
          if (v < low) low = v;
          if (v > high) high = v;
        }
      }
    }
    for (const l of levels) {
      if (l.axis === side) {
        low = Math.min(low, l.value);
        high = Math.max(high, l.value);
      }
    }
    const room = 0.06 * (high - low || 1);
    return [low - room, high + room];
  };
  const both = [reach("left"), reach("right")];
  const used = both.filter((_, i) => i === 0 || curves.some((c) => c.axis === "right"));
  const below = Math.max(...used.map(([a, b]) => -a / (b - a)));
  const above = Math.max(...used.map(([a, b]) => b / (b - a)));
  const share = below / (below + above);
  const fit = ([a, b]: Span): Span => {
    const whole = Math.max(share > 0 ? -a / share : 0, share < 1 ? b / (1 - share) : 0);
    return [-whole * share, whole * (1 - share)];
  };
  return [fit(both[0]), fit(both[1])];
}
