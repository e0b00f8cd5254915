// Interfaces of the panels: the state that panels show, the functions of the page that panels call, and the events
// that panels receive.
import type { Ink } from "./colour";
import type { Part } from "./data/format";
import type { Ghost } from "./data/ghost";
import type { Measured } from "./data/places";
import type { Span } from "./data/recording";

export interface State {
  t: number;
  joint: number; // number of the chosen joint; -1 if the robot has no joints
  playing: boolean;
  rate: number;
  span: Span; // span of the plots over time, s
}

/** A run on the page, and functions that select a time, joint or dock of the run. */
export interface Run extends Measured {
  /** Stops playing, and shows a time of this run. */
  goTo(t: number): void;
  /** Selects a joint by its number in this run. */
  choose(joint: number): void;
  /** Names a part of this run in the 3D picture instead of the joint, until a joint is selected. A dock has a ring. */
  mark(part: Part, name: string | null): void;
}

/** Interface of the page for its panels. The members inherited from Run refer to the first run. */
export interface Desk extends Run {
  /** The second run; null on a page of one run. */
  readonly ghost: Ghost | null;
  /** The first run, and the second run if there is one. */
  readonly runs: readonly Run[];
  readonly state: Readonly<State>;
  readonly ink: Ink;
  /** Shows a span of time in the plots, or the whole run if the span is null. */
  zoom(span: Span | null): void;
}

/**
 * Panel of the page, and the events that it receives. The page calls `paint` after a change of the theme, `seek` of the
 * time, `choose` of the joint, and `zoom` of the span of time. A panel observes changes of its size itself.
 */
export interface Panel {
  paint(): void;
  seek?(t: number): void;
  choose?(): void;
  zoom?(): void;
}
