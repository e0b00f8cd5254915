// What the panels of the page have in common: the state they show, and what they answer to.
import type { Ink } from "./colour";
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

/** The page, as its panels see it. */
export interface Desk {
  readonly recording: Recording;
  readonly loads: Loads;
  readonly state: Readonly<State>;
  readonly ink: Ink;
  /** Stops playing, goes to a time. */
  goTo(t: number): void;
  choose(joint: number): void;
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
