// Types of the data in the page, which report/page/page_data.cpp writes. SI units; an unknown number is null, a list
// that does not apply is [].

export type Vec3 = [number, number, number];
/** x, y, z, then the quaternion w, x, y, z. */
export type Pose = [number, number, number, number, number, number, number];

export interface Joint {
  name: string;
  module: number;
  body: number; // moved by the joint; index in bodies
  lo: number | null; // null: no stops
  hi: number | null;
  motor: number | null; // index in motors
}

/** World pose: the parent's * pre * turn(axis, angle of the joint) * post. */
export interface Body {
  name: string;
  module: number;
  type: string; // key of geometry and faces
  role: string;
  parent: number; // index in bodies, -1: the base
  joint: number; // -1: fixed to its parent
  pre: Pose;
  axis: Vec3;
  post: Pose;
}

/** Sizes: box x, y, z; cylinders along y: radius, length, 0 (half_cylinder: towards +x); sphere: radius, 0, 0. */
export interface Shape {
  kind: "box" | "cylinder" | "half_cylinder" | "sphere";
  pose: Pose;
  size: Vec3;
}

export interface Face {
  id: number;
  gender: "active" | "passive" | "none";
  origin: Vec3;
  normal: Vec3;
  reference: Vec3;
}

export interface Dock {
  name: string;
  module: number;
  parent: number;
  face: number;
  parent_face: number;
}

export interface GroundBox {
  pose: Pose;
  size: Vec3;
  moves: number; // N of the channels box.N.*; -1: fixed
}

/** Heights row by row: x runs fastest. */
export interface Heightfield {
  origin: [number, number];
  spacing: [number, number];
  nx: number;
  ny: number;
  heights: number[];
}

export interface Ground {
  kind: "none" | "plane" | "boxes" | "heightfield";
  height: number;
  friction: number | null;
  boxes: GroundBox[];
  heightfield: Heightfield | null;
}

export interface Foot {
  name: string; // name of the body
  title: string; // name of the leg in figures (m5 rear left), else of the body
  module: number;
  body: number;
}

/** Available torques: from `least` to `most` at each speed; no samples: the limit is unknown. */
export interface Motor {
  unit: "V" | "N m"; // unit of the command
  command: number | null;
  current: number | null;
  continuous: number | null; // A
  rest: number | null; // N m
  no_load: number | null; // rad/s
  speed: number[];
  most: number[];
  least: number[];
}

export type Status = "pass" | "warn" | "fail" | "too close" | "not judged";
export type Part = "none" | "joint" | "body" | "dock" | "foot";

/** Result of a check; value, limit, unit and margin belong to the criterion that decides it. */
export interface Check {
  id: string;
  group: string;
  title: string;
  status: Status;
  span: "window" | "whole run";
  can_fail: boolean;
  value: number | null;
  limit: number | null;
  least: boolean; // true for a lower limit
  unit: string; // "" for a share
  margin: number | null; // as a share of the limit; negative beyond it
  error: number | null; // relative error of the value
  part: Part; // kind of worst and first_part
  worst: string | null; // name of the worst part; for a dock the name of its module
  parts: number; // number of parts beyond the limit
  from: number | null; // s: start of the time of the worst part beyond the limit
  to: number | null;
  first: number | null; // s: first time of a part beyond the limit
  first_part: string | null;
  remedy: string; // setting that helps, if one is known
  advice: string; // general remedy
  missing: string;
  definition: string;
  source: string;
  text: string;
}

export interface Verdict {
  format: 2;
  verdict: "feasible" | "infeasible" | "failed" | "not judged";
  reason: string; // reason of `not judged`
  why: string; // text after the verdict, as on the terminal; "" for feasible
  decided_by: string | null; // id of the check that decides `failed` or `infeasible`
  tightest: string | null; // id of the check with the smallest margin, among checks that can fail
  rests_on: string; // evidence: `3 periods of 4 s`
  /** Joint at limits of its motor for the largest share of the judged time. */
  longest: { joint: string; voltage: number; current: number } | null;
  /** First joint at a limit of its motor, for however short a time; s. */
  first: { joint: string; time: number } | null;
  window: { from: number; to: number };
  counts: Record<Status, number>;
  checks: Check[];
  chosen_motors?: boolean; // data of the motors are chosen, not the manufacturer's
  chosen_docks?: boolean; // strengths of the docks are chosen
  demand?: { doubt: string; joints: Demand[] }; // only with --demand
}

/** Largest magnitudes of a joint in a run without motor limits. */
export interface Demand {
  joint: string;
  voltage: number | null;
  current: number | null;
  torque: number | null;
  speed: number | null;
}

/** Part of summary.json that the page uses. */
export interface Summary {
  speed?: number | null;
  distance?: number | null;
  cost_of_transport?: { electrical: number | null; mechanical: number | null } | null;
  energy?: Record<string, number | null> | null;
  trace_hash?: string;
}

/** Name, unit, size of a step, number of values. */
export type Channel = [name: string, unit: string, quantum: number, count: number];

/** Amplitude and phase of a first harmonic, rad. */
export type Harmonic = [amplitude: number, phase: number];

/** Signal of the second run that left its band around the signal of the first run. */
export interface Stray {
  signal: string; // name of the channel
  unit: string;
  ratio: number; // RMS of the difference, in bands
  tolerance: number; // largest permitted difference at a time, in the unit
  from: number | null; // s: the first time beyond the tolerance
}

/** Second run on the page (report/page/page_overlay.h). */
export interface Overlay {
  labels: [own: string, second: string];
  differs: string[]; // settings that differ
  strayed: string | null; // reason why a run failed against its golden; null: a page of two runs
  strays: Stray[];
  differences: Channel[]; // second run minus first, per stray signal
  run: Meta;
}

export interface Meta {
  format: 1;
  name: string;
  build: string;
  engine: string;
  integrator: string;
  step: number | null;
  accuracy: number | null;
  period: number;
  rows: number;
  duration: number;
  outcome: string; // "done"; "not run" for a robot that was only checked; else the reason of an early end
  mass: number;
  weight: number;
  modules: { name: string; type: string }[];
  joints: Joint[];
  bodies: Body[];
  geometry: Record<string, Shape[]>;
  faces: Record<string, Face[]>;
  docks: Dock[];
  contacts: string[];
  ground: Ground;
  feet: Foot[];
  motors: Motor[];
  verdict: Verdict;
  summary: Summary;
  cycle: { from: number; period: number } | null;
  phases: { setpoint: Harmonic; angle: Harmonic }[];
  cpg: string;
  frequency: number | null;
  command: string;
  missing: string[];
  scenario: string;
  channels: Channel[];
  overlay?: Overlay;
}
