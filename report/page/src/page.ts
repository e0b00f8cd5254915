// Page of the report: the panels, and the time, joint and span of time that the panels show.
import { Address } from "./address";
import { captions } from "./verdict/captions";
import { inkOf, type Ink, type Theme } from "./colour";
import { element } from "./dom";
import type { Check, Part } from "./data/format";
import { Ghost } from "./data/ghost";
import { arrange } from "./layout";
import { Loads } from "./data/loads";
import { opening, type Opening } from "./verdict/opening";
import type { Desk, Panel, Run, State } from "./panel";
import { jointAt } from "./data/places";
import { Problems } from "./verdict/problems";
import type { Recording, Second, Span } from "./data/recording";
import { Stage } from "./scene/stage";
import { Transport } from "./transport";
import type { Look } from "./scene/view";

type Stretch = "all" | "four" | "one";

export class Page implements Desk {
  readonly loads: Loads;
  readonly ghost: Ghost | null;
  readonly runs: readonly Run[];
  readonly state: State;
  readonly stage: Stage;
  ink: Ink;
  private readonly panels: Panel[] = [];
  private readonly stretches: Record<Stretch, number>;
  readonly address = new Address();
  private width: number; // width of the span that the page chooses, s; 0 if the reader has selected a span
  private last: number | null = null; // time of the frame before, ms; null while the page does not play
  private late = 0; // number of consecutive slow frames

  constructor(
    readonly recording: Recording,
    laid: Second | null,
  ) {
    const { link } = this.address;
    const all = recording.end || 1;
    const period = recording.meta.cycle?.period ?? 2;
    const dark = link.get("theme") ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    this.ink = painted(dark === "dark" ? "dark" : "light");
    this.loads = new Loads(recording);
    this.ghost = laid && new Ghost(laid, recording);
    this.runs = [this, ...(this.ghost ? [this.asRun(this.ghost)] : [])];
    this.stretches = { all, four: Math.min(all, 4 * period), one: Math.min(all, period) };
    this.width = this.stretches.four;
    const first = opening(this, link);
    this.state = { t: this.within(first.t), joint: first.joint, playing: false, rate: 1, span: [0, all] };
    this.state.span = this.spanAround();
    captions(this);
    this.stage = new Stage(this, (on) => this.align(on));
    this.panels.push(this.stage, ...this.transport(), ...arrange(this));
    this.offerStretches();
    this.panels.forEach((p) => p.paint());
    this.open(first);
  }

  /** Shows the first view. */
  private open({ run, check, joint }: Opening): void {
    const { link } = this.address;
    const planned = this.recording.meta.outcome === "not run";
    const { view } = this.stage;
    const near = ({ part, worst }: Check) =>
      !!view && (run.recording === this.recording ? view.near(part, worst) : view.near("joint", this.jointName));
    this.choose(joint);
    view?.look((link.get("look") as Look | null) ?? "iso");
    const own = check ? jointAt(run.recording.meta, check.part, check.worst) : -1;
    if (check && (own === joint || !link.has("joint"))) run.mark(check.part, check.worst);
    // The camera moves to the part of a failed check, unless the link selects a view, joint or time.
    const free = !["look", "joint", "t"].some((key) => link.has(key));
    if (check && ["fail", "too close"].includes(check.status) && free) near(check);
    new Problems(run, near);
    for (const marks of ["faces", "axes"] as const) {
      if ((planned || link.has(marks)) && !element(marks).hidden) this.stage.switch(marks);
    }
  }

  private get jointName(): string | null {
    return this.recording.meta.joints[this.state.joint]?.name ?? null;
  }

  private transport(): Panel[] {
    const { ran } = this.recording;
    element("transport").hidden = !ran;
    const rate = (x: number) => {
      this.state.rate = x;
    };
    return ran ? [new Transport(this, (on) => this.play(on), rate)] : [];
  }

  // --- requests of panels

  goTo(t: number): void {
    this.play(false);
    this.seek(t);
  }

  choose(joint: number): void {
    const n = this.recording.meta.joints.length;
    if (!n) return;
    this.state.joint = (joint + n) % n;
    element<HTMLSelectElement>("joint").value = String(this.state.joint);
    for (const p of this.panels) p.choose?.();
    this.seek(this.state.t);
  }

  mark(part: Part, name: string | null): void {
    this.stage.mark(part, name);
  }

  zoom(span: Span | null): void {
    this.width = span ? 0 : this.stretches.all;
    this.show(span ?? [0, this.recording.end]);
  }

  /** Shows the second run at the same phase of its gait, or at the same time. */
  private align(on: boolean): void {
    if (!this.ghost) return;
    this.ghost.aligned = on;
    this.panels.forEach((p) => p.paint());
    this.seek(this.state.t);
  }

  private asRun(ghost: Ghost): Run {
    const { recording, loads } = ghost;
    return {
      recording,
      loads,
      goTo: (t) => this.goTo(ghost.back(t)),
      choose: (joint) => {
        if (ghost.jointBack(joint) >= 0) this.choose(ghost.jointBack(joint));
      },
      mark: (part, name) => this.mark(part, name),
    };
  }

  // --- time

  seek(t: number): void {
    const { state } = this;
    state.t = this.within(t);
    if (this.width && (state.t < state.span[0] - 1e-9 || state.t > state.span[1] + 1e-9)) this.show(this.spanAround());
    else {
      for (const p of this.panels) p.seek?.(state.t);
    }
    if (!state.playing) this.address.remember(this);
  }

  play(on: boolean): void {
    if (!this.recording.ran) return;
    this.state.playing = on;
    this.last = null;
    this.seek(on && this.state.t >= this.recording.end - 1e-9 ? 0 : this.state.t);
  }

  /** Advances the time if the page plays, and draws. The browser calls this function once per frame. */
  tick(now: number): void {
    if (this.state.playing && this.last !== null) {
      const t = this.state.t + ((now - this.last) / 1000) * this.state.rate;
      this.seek(t > this.recording.end ? 0 : t);
      this.late = now - this.last > 55 ? this.late + 1 : 0;
      if (this.late > 10) {
        this.stage.view?.lighten();
        this.late = 0;
      }
    }
    this.last = this.state.playing ? now : null;
    this.stage.draw();
  }

  theme(name: Theme): void {
    this.ink = painted(name);
    this.panels.forEach((p) => p.paint());
  }

  private show(span: Span): void {
    this.state.span = span;
    for (const b of document.querySelectorAll<HTMLElement>("[data-stretch]")) {
      b.setAttribute("aria-pressed", String(this.stretches[b.dataset.stretch as Stretch] === this.width));
    }
    for (const p of this.panels) p.zoom?.();
    for (const p of this.panels) p.seek?.(this.state.t);
  }

  /** Span of time that contains the time shown. Spans adjoin and end with the run, so that plots turn like pages. */
  private spanAround(): Span {
    const { width } = this;
    const { end } = this.recording;
    if (width >= end) return [0, end || 1];
    const pages = Math.floor((end - this.state.t) / width + 1e-9);
    const to = Math.max(end - pages * width, width);
    return [to - width, to];
  }

  private within(t: number): number {
    return Math.min(Math.max(t, 0), this.recording.end);
  }

  private offerStretches(): void {
    for (const b of document.querySelectorAll<HTMLElement>("[data-stretch]")) {
      const stretch = b.dataset.stretch as Stretch;
      b.addEventListener("click", () => {
        this.width = this.stretches[stretch];
        this.show(this.spanAround());
      });
      b.hidden = stretch !== "all" && this.stretches[stretch] >= this.stretches.all;
    }
    this.show(this.state.span);
  }
}

/** Sets the theme of the document. Returns the colours of this theme. */
function painted(theme: Theme): Ink {
  document.documentElement.dataset.theme = theme;
  element("theme").textContent = theme === "dark" ? "Light" : "Dark";
  return inkOf(document.documentElement);
}
