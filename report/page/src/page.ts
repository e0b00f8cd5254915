// The page: its state, its panels, what keys and links do.
import { about, blocks, explained, title } from "./about";
import { Balance } from "./balance";
import { inkOf, type Ink, type Theme } from "./colour";
import { checks } from "./checks";
import { demand } from "./demand";
import { docks } from "./docks";
import { element, make, panelOf } from "./dom";
import { Energy } from "./energy";
import { Envelope } from "./envelope";
import { Footfalls } from "./footfalls";
import { Ghost } from "./ghost";
import { folder } from "./folder";
import { headline, leading } from "./headline";
import { HeatMap } from "./heatmap";
import { JointPlots } from "./joint_plots";
import { Loads } from "./loads";
import { number } from "./numbers";
import { Overview } from "./overview";
import type { Desk, Panel, Run, Span, State } from "./panel";
import { parts } from "./parts";
import { dockAt, jointAt, moment } from "./places";
import { Path } from "./path";
import { Phases } from "./phases";
import type { Recording, Second } from "./recording";
import { Stage } from "./stage";
import { Strays } from "./strays";
import { Transport } from "./transport";
import type { Look } from "./view";

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
  private readonly link: URLSearchParams;
  private width: number; // s, of the stretch that turns like a page; 0: one that the reader chose
  private last: number | null = null; // ms, of the frame before, while playing
  private late = 0; // frames

  constructor(readonly recording: Recording, laid: Second | null) {
    const { meta } = recording, { cycle, verdict } = meta;
    this.link = new URLSearchParams(location.hash.slice(1));
    const dark = this.link.get("theme") ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    document.documentElement.dataset.theme = dark === "dark" ? "dark" : "light";
    this.ink = inkOf(document.documentElement);
    this.loads = new Loads(recording);
    this.ghost = laid && new Ghost(laid, recording);
    this.runs = [this, ...(this.ghost ? [this.asRun(this.ghost)] : [])];
    const all = recording.end || 1, period = cycle?.period ?? 2;
    this.stretches = { all, four: Math.min(all, 4 * period), one: Math.min(all, period) };
    this.width = this.stretches.four;
    // Of two runs the first that is not feasible.
    const fails = (run: Run) => ["infeasible", "failed"].includes(run.recording.meta.verdict.verdict), shown = this.runs.find(fails) ?? this.runs[0], second = shown !== this.runs[0];
    const check = meta.outcome === "not run" ? null : leading(shown), theirs = check ? jointAt(shown.recording.meta, check.part, check.worst) : -1, seen = check && moment(shown, check);
    const stray = this.ghost?.overlay.strays[0], strayed = /^joint\.(\d+)\./.exec(stray?.signal ?? ""), linked = meta.joints.findIndex((j) => j.name === this.link.get("joint"));
    const start = [linked, strayed ? Number(strayed[1]) : -1, second ? this.ghost!.jointBack(theirs) : theirs].find((j) => j >= 0) ?? this.loads.hardest.joint;
    this.state = { t: 0, joint: meta.joints.length ? start : -1, playing: false, rate: 1, span: [0, all] };
    const t = this.link.has("t") ? Number(this.link.get("t")) : stray?.from ?? (second && seen !== null ? this.ghost!.back(seen) : seen) ?? (!recording.ran ? 0 : meta.joints.length ? this.loads.hardest.t : verdict.window.from);
    this.state.t = this.within(Number.isFinite(t) ? t : 0);
    this.state.span = this.spanAround();
    this.text();
    this.stage = new Stage(this, (on) => this.align(on));
    this.panels.push(this.stage);
    this.arrange();
    this.wire();
    this.panels.forEach((p) => p.paint());
    this.choose(this.state.joint);
    this.stage.view?.look((this.link.get("look") as Look | null) ?? "iso");
    if (check) shown.mark(dockAt(shown.recording.meta, check.part, check.worst));
    for (const marks of ["faces", "axes"] as const) if (meta.outcome === "not run" || this.link.has(marks)) this.press(marks);
  }

  // --- what panels ask for

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

  mark(dock: number): void { this.stage.mark(dock); }

  zoom(span: Span | null): void {
    this.width = span ? 0 : this.stretches.all;
    this.show(span ?? [0, this.recording.end]);
  }

  /** The second run at the same phase of its gait, or at the same time. */
  align(on: boolean): void {
    if (!this.ghost) return;
    this.ghost.aligned = on;
    this.panels.forEach((p) => p.paint());
    this.seek(this.state.t);
  }

  private asRun(ghost: Ghost): Run {
    const { recording, loads } = ghost;
    return { recording, loads, goTo: (t) => this.goTo(ghost.back(t)), choose: (joint) => { if (ghost.jointBack(joint) >= 0) this.choose(ghost.jointBack(joint)); }, mark: (dock) => this.mark(dock < 0 ? -1 : this.recording.meta.docks.findIndex((_, n) => ghost.number("dock", n) === dock)) };
  }

  // --- time

  seek(t: number): void {
    const { state } = this;
    state.t = this.within(t);
    if (this.width && (state.t < state.span[0] - 1e-9 || state.t > state.span[1] + 1e-9)) this.show(this.spanAround());
    else for (const p of this.panels) p.seek?.(state.t);
    if (!state.playing) this.remember();
  }

  play(on: boolean): void {
    if (!this.recording.ran) return;
    this.state.playing = on;
    this.last = null;
    this.seek(on && this.state.t >= this.recording.end - 1e-9 ? 0 : this.state.t);
  }

  /** Once per frame of the browser. */
  tick(now: number): void {
    if (this.state.playing && this.last !== null) {
      const t = this.state.t + (now - this.last) / 1000 * this.state.rate;
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
    document.documentElement.dataset.theme = name;
    this.ink = inkOf(document.documentElement);
    element("theme").textContent = name === "dark" ? "Light" : "Dark";
    this.panels.forEach((p) => p.paint());
  }

  private show(span: Span): void {
    this.state.span = span;
    for (const b of document.querySelectorAll<HTMLElement>("[data-stretch]")) b.setAttribute("aria-pressed", String(this.stretches[b.dataset.stretch as Stretch] === this.width));
    for (const p of this.panels) p.zoom?.();
    for (const p of this.panels) p.seek?.(this.state.t);
  }

  /** The stretch that holds the time shown, on a grid that ends with the run: so the plots turn like pages. */
  private spanAround(): Span {
    const { width, recording: { end } } = this;
    if (width >= end) return [0, end || 1];
    const pages = Math.floor((end - this.state.t) / width + 1e-9), to = Math.max(end - pages * width, width);
    return [to - width, to];
  }

  private within(t: number): number { return Math.min(Math.max(t, 0), this.recording.end); }

  // --- what the page consists of

  private text(): void {
    const { meta } = this.recording, ran = meta.outcome !== "not run";
    element("name").textContent = title(this.runs);
    element("about").textContent = this.ghost ? (this.ghost.overlay.strayed ? about(meta) : "") : about(meta);
    headline(this);
    element("foot-text").textContent = this.origin().join(" ");
    element("scenario").textContent = meta.scenario;
    const { window, checks: all } = meta.verdict;
    element("definitions").parentElement!.hidden = !ran || !all.length;
    if (ran) element("definitions").append(...explained(meta).map((text) => make("p", text)), make("p", `Judged from ${number(window.from, 4)} to ${number(window.to, 4)} s; what breaks at once (docks, gears, stops, collisions, falls) in the whole run, its start included.`),
      make("ul", ...all.filter((c) => c.definition).map((c) => make("li", make("b", c.title), `: ${c.definition}${c.source ? ` (limit: ${c.source})` : ""}`))));
  }

  /** Which program made the runs, and how they can be made again. */
  private origin(): string[] {
    const { meta } = this.recording, overlay = this.ghost?.overlay, builds = new Set(this.runs.map((r) => r.recording.meta.build)), made = `gaitlab ${[...builds].join(" and ")}.`;
    if (meta.outcome === "not run" || overlay?.strayed) return [made];
    const hashes = this.runs.map((r, n) => `${overlay ? `${overlay.labels[n]} ` : ""}${r.recording.meta.summary.trace_hash ?? "unknown"}`);
    return [made, `Trace hash: ${hashes.join(", ")}.`, "Values on this page are rounded. The trace has them in full.", `The same run again: ${meta.command.replace("FOLDER", folder())}`];
  }

  private arrange(): void {
    const { recording } = this, { meta } = recording, jointed = meta.joints.length > 0;
    const keep = (id: string, when: boolean) => {
      panelOf(id).hidden = !when;
      return when;
    };
    element("joint").title = blocks(meta);
    for (const [n, joint] of meta.joints.entries()) element("joint").append(new Option(`${n}  ${joint.name}`, String(n)));
    if (keep("checks", meta.outcome !== "not run" && this.runs.some((r) => r.recording.meta.verdict.checks.length > 0))) checks(this);
    if (keep("drift", !!this.ghost?.overlay.strayed) && keep("strays", true)) this.panels.push(new Strays(this));
    else keep("strays", false);
    if (keep("demand", this.runs.some((r) => r.recording.meta.verdict.demand?.joints.length))) demand(this);
    if (keep("parts", meta.outcome === "not run")) parts(this);
    element("transport").hidden = !recording.ran;
    if (recording.ran) {
      this.panels.push(new Transport(this, (on) => this.play(on), (x) => { this.state.rate = x; }), new Overview(this));
    }
    if (keep("motion", recording.ran && jointed)) this.panels.push(new JointPlots(this));
    if (keep("envelope", recording.ran && jointed)) this.panels.push(new Envelope(this));
    if (keep("heat", recording.ran && jointed)) this.panels.push(new HeatMap(this));
    if (keep("foot", recording.ran && meta.ground.kind !== "none")) this.panels.push(new Footfalls(this));
    if (keep("path", recording.ran && meta.ground.kind !== "none")) this.panels.push(new Path(this), new Balance(this));
    if (keep("docks", recording.ran && meta.docks.length > 0 && !this.ghost?.overlay.strayed)) docks(this);
    if (keep("phase", recording.ran && jointed)) this.panels.push(new Phases(this));
    if (keep("energy", recording.ran && jointed)) this.panels.push(new Energy(this));
    // A golden lacks on purpose what its page leaves out.
    if (this.ghost?.overlay.strayed) element("left-out").hidden = true;
    // Those that have nothing to show are left out by now.
    for (const row of document.querySelectorAll<HTMLElement>(".row")) {
      const shown = [...row.children].filter((c) => !(c as HTMLElement).hidden).length;
      row.hidden = !shown;
      row.dataset.panels = String(shown);
    }
  }

  private press(id: "faces" | "axes"): void {
    if (!element(id).hidden) this.stage.switch(id);
  }

  // --- buttons, keys, paper

  private wire(): void {
    element("theme").textContent = this.ink.theme === "dark" ? "Light" : "Dark";
    const on = (id: string, act: () => void) => element(id).addEventListener("click", act);
    on("theme", () => this.theme(this.ink.theme === "dark" ? "light" : "dark"));
    on("print", () => window.print());
    on("keys", () => {
      const list = element("keylist");
      list.hidden = !list.hidden;
      element("keys").setAttribute("aria-expanded", String(!list.hidden));
    });
    on("previous", () => this.choose(this.state.joint - 1));
    on("next", () => this.choose(this.state.joint + 1));
    element("joint").addEventListener("change", (e) => this.choose(Number((e.target as HTMLSelectElement).value)));
    for (const b of document.querySelectorAll<HTMLElement>("[data-stretch]")) {
      b.addEventListener("click", () => {
        this.width = this.stretches[b.dataset.stretch as Stretch];
        this.show(this.spanAround());
      });
      b.hidden = b.dataset.stretch !== "all" && this.stretches[b.dataset.stretch as Stretch] >= this.stretches.all;
    }
    this.show(this.state.span);
    addEventListener("keydown", (e) => this.key(e));
    let before: Theme | null = null;
    addEventListener("beforeprint", () => {
      if (before) return;
      before = this.ink.theme;
      this.play(false);
      document.documentElement.classList.add("printing");
      this.theme("light");
      this.stage.freeze(true);
    });
    addEventListener("afterprint", () => {
      if (!before) return;
      document.documentElement.classList.remove("printing");
      this.stage.freeze(false);
      this.theme(before);
      before = null;
    });
  }

  private key(e: KeyboardEvent): void {
    const target = e.target as HTMLElement;
    if (target.matches("select, input:not(#time)") || e.ctrlKey || e.metaKey || e.altKey) return;
    const { state, recording } = this, step = e.shiftKey ? 0.1 : recording.meta.period, look = (from: Look) => () => this.stage.view?.look(from);
    const press = (id: string) => () => { if (!element(id).hidden) element(id).click(); };
    const acts: Record<string, () => void> = {
      " ": () => this.play(!state.playing), ArrowLeft: () => this.goTo(state.t - step), ArrowRight: () => this.goTo(state.t + step), Home: () => this.goTo(0), End: () => this.goTo(recording.end),
      "[": () => this.choose(state.joint - 1), "]": () => this.choose(state.joint + 1), 1: look("iso"), 2: look("side"), 3: look("top"), 4: look("front"), j: () => this.stage.frame(state.joint),
      f: press("follow"), c: press("forces"), n: press("faces"), a: press("axes"), k: press("rings"), d: press("theme"), z: () => this.zoom(null), p: press("align"), "?": press("keys"),
    };
    const act = acts[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (!act || (e.key === " " && target.matches("button, summary"))) return;
    e.preventDefault();
    act();
  }

  // The address names what is shown, so that it can be copied; not more often than browsers allow.
  private remembering = 0;
  private remember(): void {
    clearTimeout(this.remembering);
    if (this.link.has("paused") || !this.recording.ran) return;
    this.remembering = window.setTimeout(() => {
      const joint = this.recording.meta.joints[this.state.joint]?.name;
      const parts = [...(joint ? [`joint=${encodeURIComponent(joint).replaceAll("%2F", "/")}`] : []), `t=${+this.state.t.toFixed(3)}`];
      try {
        history.replaceState(null, "", `#${parts.join("&")}`);
      } catch {
        // A page within another page may not.
      }
    }, 400);
  }
}
