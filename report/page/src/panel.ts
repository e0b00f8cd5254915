// What the panels of the page have in common: the state they show, and what they answer to.
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

/** One of the page's runs, and the way to a place in it. */
export interface Run {
  readonly recording: Recording;
  readonly loads: Loads;
  /** Stops playing, goes to a time of this run. */
  goTo(t: number): void;
  /** The number of one of this run's joints. */
  choose(joint: number): void;
  /** The number of one of this run's docks, which the 3D picture marks; -1: none. */
  mark(dock: number): void;
}

/** The page, as its panels see it: of its own run. */
export interface Desk extends Run {
  /** The run that is laid over it. */
  readonly ghost: Ghost | null;
  /** Its own run, and the one that is laid over it. */
  readonly runs: readonly Run[];
  readonly state: Readonly<State>;
  readonly ink: Ink;
  /** null: the whole run. */
  zoom(span: Span | null): void;
}

/** A panel draws itself anew when the theme has changed (a new size it sees itself), the rest where it shows what changed. */
export interface Panel {
  paint(): void;
  seek?(t: number): void;
  choose?(): void;
  zoom?(): void;
}
