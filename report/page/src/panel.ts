// Interfaces of the panels: the state that they show, the page as they use it, the events that they receive.
import type { Ink } from "./colour";
import type { Ghost } from "./ghost";
import type { Loads } from "./loads";
import type { Recording } from "./recording";

export type Span = [from: number, to: number];

export interface State {
  t: number;
  joint: number; // -1: the robot has none
  playing: boolean;
  rate: number;
  span: Span; // s, of the plots over time
}

/** A run on the page, and selection of a time, joint or dock in it. */
export interface Run {
  readonly recording: Recording;
  readonly loads: Loads;
  /** Stops playing, and shows a time of this run. */
  goTo(t: number): void;
  /** Selects a joint by its number in this run. */
  choose(joint: number): void;
  /** Marks a dock in the 3D picture by its number in this run; -1: none. */
  mark(dock: number): void;
}

/** The page as its panels use it; members of Run refer to its first run. */
export interface Desk extends Run {
  /** The second run. */
  readonly ghost: Ghost | null;
  /** The first run, and the second run if there is one. */
  readonly runs: readonly Run[];
  readonly state: Readonly<State>;
  readonly ink: Ink;
  /** Shows a span of time in the plots; null: the whole run. */
  zoom(span: Span | null): void;
}

/** Events of a panel: paint for a new theme (a panel observes its size itself), the others if they concern it. */
export interface Panel {
  paint(): void;
  seek?(t: number): void;
  choose?(): void;
  zoom?(): void;
}
