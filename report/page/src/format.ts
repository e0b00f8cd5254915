// What the program writes into the page: report/page/page_data.cpp. SI units; what is not known is null, what does not apply is [].

export type Vec3 = [number, number, number];
/** x, y, z, then the quaternion w, x, y, z. */
export type Pose = [number, number, number, number, number, number, number];

export interface Joint {
  name: string;
  module: number;
  body: number; // that it moves; index in bodies
  lo: number | null; // null: it turns freely
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

/** box: x y z; cylinders, along y: radius, length, 0 (the half one bulges towards +x); sphere: radius, 0, 0. */
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
  moves: number; // -1: never; else the N of the channels box.N.*
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
  name: string; // of the body
  title: string; // of its leg in figures: m5 rear left; else the name
  module: number;
  body: number;
}

/** The torque that is available between `least` and `most` at each of the speeds; no samples: no limit is known. */
export interface Motor {
  unit: "V" | "N m"; // of its command
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

/** value, limit, unit and margin are those of the criterion that decides. */
export interface Check {
  id: string;
  group: string;
  title: string;
  status: Status;
  span: "window" | "whole run";
  can_fail: boolean;
  value: number | null;
  limit: number | null;
  least: boolean; // the limit is the least that is allowed
  unit: string; // "": a share
  margin: number | null; // share of the limit that is left; negative: beyond it
  error: number | null; // share by which the value may be off
  part: Part; // of worst and first_part
  worst: string | null; // a dock by its module
  parts: number; // beyond the limit
  from: number | null; // s: when the worst part was
  to: number | null;
  first: number | null; // s: when any part was beyond the limit first
  first_part: string | null;
  remedy: string; // what to set; "": no setting is known to help
  advice: string; // what helps in general
  missing: string;
  definition: string;
  source: string;
  text: string;
}

export interface Verdict {
  format: 2;
  verdict: "feasible" | "infeasible" | "failed" | "not judged";
  reason: string; // of `not judged`
  why: string; // behind the word, as the terminal has it; "" of feasible
  decided_by: string | null; // id of the check that `failed` and `infeasible` rest on
  tightest: string | null; // id of the check that can fail with the least margin
  rests_on: string; // `3 periods of 4 s`
  /** The joint that is at limits of its motor for the largest share of the judged time. */
  longest: { joint: string; voltage: number; current: number } | null;
  /** The first joint of the run at a limit of its motor, however shortly; s. */
  first: { joint: string; time: number } | null;
  window: { from: number; to: number };
  counts: Record<Status, number>;
  checks: Check[];
  chosen_motors?: boolean; // figures of the motors are chosen, not a maker's
  chosen_docks?: boolean; // the same of what docks hold
  demand?: { doubt: string; joints: Demand[] }; // only where somebody asked
}

/** Largest magnitudes of a joint in a run whose motors have no limits. */
export interface Demand {
  joint: string;
  voltage: number | null;
  current: number | null;
  torque: number | null;
  speed: number | null;
}

/** Of summary.json, what the page reads. */
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

/** A signal of the second run that left its band around the first one's. */
export interface Stray {
  signal: string; // a channel
  unit: string;
  ratio: number; // RMS of the difference, in bands
  tolerance: number; // in the unit: how far it may be away at a time
  from: number | null; // s: the first time beyond the tolerance
}

/** A second run, which is laid over the page's own: report/page/page_overlay.h. */
export interface Overlay {
  labels: [own: string, second: string];
  differs: string[]; // settings
  strayed: string | null; // a run that strayed from its golden; null: a page of two runs
  strays: Stray[];
  differences: Channel[]; // second less own, of each stray by its signal
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
  outcome: string; // "done"; "not run": a robot that was only checked; else why the run ended early
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
