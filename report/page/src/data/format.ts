// Types of the data in the page, which report/page/page_data.cpp writes. Numbers are in SI units. An unknown number is
// null, and a list that does not apply to the run is [].

type Vec3 = [number, number, number];
/** Position x, y, z in m, then the quaternion w, x, y, z. */
export type Pose = [number, number, number, number, number, number, number];

interface Joint {
  name: string;
  module: number;
  body: number; // index in bodies of the body that the joint moves
  lo: number | null; // ends of the range, rad; null if the hinge has no stops
  hi: number | null;
  motor: number | null; // index in motors; null if the joint has no motor with known data
}

/** Body of the robot. Its world pose is (world pose of the parent) * pre * turn(axis, angle of the joint) * post. */
interface Body {
  name: string;
  module: number;
  type: string; // key of geometry and faces
  role: string;
  parent: number; // index in bodies; -1 if the base is the parent
  joint: number; // index in joints; -1 if the body is fixed to its parent
  pre: Pose;
  axis: Vec3;
  post: Pose;
}

/**
 * Piece of a body. The size is x, y, z of a box; radius, length, 0 of a cylinder along y; radius, 0, 0 of a sphere.
 * A half_cylinder is the half at positive x of a cylinder. A hull has corners, and faces as indices of corners,
 * counter-clockwise as seen from outside.
 */
export interface Shape {
  kind: "box" | "cylinder" | "half_cylinder" | "sphere" | "hull";
  pose: Pose;
  size: Vec3;
  corners?: Vec3[];
  faces?: number[][];
}

export interface Face {
  id: number;
  gender: "active" | "passive" | "none";
  origin: Vec3;
  normal: Vec3;
  reference: Vec3;
}

interface Dock {
  name: string;
  module: number;
  parent: number;
  face: number;
  parent_face: number;
}

interface GroundBox {
  pose: Pose;
  size: Vec3;
  moves: number; // N of the channels box.N.* of a moving box; -1 for a fixed box
}

/** Heights on a grid of nx by ny points. The height at point (i, k) is heights[k * nx + i], m. */
export interface Heightfield {
  origin: [number, number];
  spacing: [number, number];
  nx: number;
  ny: number;
  heights: number[];
}

interface Ground {
  kind: "none" | "plane" | "boxes" | "heightfield";
  height: number;
  friction: number | null;
  boxes: GroundBox[];
  heightfield: Heightfield | null;
}

interface Foot {
  name: string; // name of the body
  title: string; // name of the leg as in figures (rear left), or of the body if the leg has no name
  module: number;
  body: number;
  points?: [x: number, y: number, z: number, radius: number][]; // contact elements in body axes, m
}

/**
 * Limits of a motor. The available torque at speed[k] is between least[k] and most[k], N m and rad/s. The lists are
 * empty if the limit is unknown.
 */
export interface Motor {
  unit: "V" | "N m"; // unit of the command
  command: number | null; // largest command
  current: number | null; // largest current, A
  continuous: number | null; // continuous current, A
  rest: number | null; // torque at rest, N m
  no_load: number | null; // speed without load, rad/s
  speed: number[];
  most: number[];
  least: number[];
}

export type Status = "pass" | "warn" | "fail" | "too close" | "not judged";
export type Part = "none" | "joint" | "body" | "dock" | "foot";

/** Result of a check. Value, limit, unit and margin belong to the criterion that decides the check. */
export interface Check {
  id: string;
  group: string;
  title: string;
  status: Status;
  span: "window" | "whole run";
  value: number | null;
  limit: number | null;
  least: boolean; // true for a lower limit
  unit: string; // unit of value and limit; "" for a share
  margin: number | null; // margin as a share of the limit; negative if the value is beyond the limit
  part: Part; // kind of part of the names worst and first_part
  worst: string | null; // name of the worst part; for a dock the name of its module
  from: number | null; // start of the time that the worst part is beyond the limit, s
  to: number | null; // end of the time that the worst part is beyond the limit, s
  first: number | null; // first time at which a part is beyond the limit, s
  first_part: string | null; // name of the part that is beyond the limit first
  remedy: string; // setting that helps, if one is known
  advice: string; // general remedy; "" if a remedy was searched
  missing: string;
  definition: string;
  source: string;
  text: string;
}

export interface Verdict {
  verdict: "feasible" | "infeasible" | "failed" | "not judged";
  reason: string; // reason of `not judged`
  reason_code?: string;
  retry?: string[]; // settings, as for --set, of a run that is expected to have a verdict
  reason_check?: string; // id of the check that it names: too close, failing so far, or not judged
  events?: { time: number; check: string; part: string | null }[]; // failed checks by the time at which they first fail
  failures: string[]; // ids of the failed checks: the one that decides, those of group `run`, then by margin
  why: string; // text after the verdict, as on the terminal; "" for feasible
  unstable?: string; // sentence on an unstable controller, from which all other findings follow
  decided_by: string | null; // id of the check that decides `failed` or `infeasible`
  tightest: string | null; // id of the check with the smallest margin, among checks that can fail
  rests_on: string; // evidence for the verdict, for example `3 periods of 4 s`
  /** Joint at limits of its motor for the largest share of the judged time. */
  longest: { joint: string; voltage: number; current: number } | null;
  window: { from: number; to: number };
  counts: Record<Status, number>;
  checks: Check[];
  chosen_motors?: boolean; // data of the motors are chosen, not the manufacturer's
  chosen_docks?: boolean; // strengths of the docks are chosen
  demand?: { doubt: string; joints: Demand[] }; // only with --demand
  remedy?: Remedy; // only with `gaitlab remedy`
  draws?: { text: string; count: number; feasible: number }; // only with --draws
}

/** Result of `gaitlab remedy`: remedy.json. */
export interface Remedy {
  verdict: Verdict["verdict"];
  text: string[]; // lines as on the terminal
  tones: ("good" | "plain" | "doubtful" | "bad")[]; // tones of the lines
  runs: number;
  map?: RemedyMap;
}

/**
 * Runs over frequency and amplitude. The cells are row by row, one row per amplitude. A factor multiplies the value
 * `now`.
 */
export interface RemedyMap {
  factors: number[];
  frequency: { now: number | null; unit: string }; // null if joints have different values
  amplitude: { now: number | null; unit: string };
  cells: { verdict: Verdict["verdict"]; margin: number | null; speed: number | null; weakest: string }[];
}

/** Largest magnitudes of a joint in a run without motor limits, V, A, N m and rad/s. */
interface Demand {
  joint: string;
  voltage: number | null;
  current: number | null;
  torque: number | null;
  speed: number | null;
}

/** Part of summary.json that the page uses. */
interface Summary {
  speed?: number | null;
  cost_of_transport?: { electrical: number | null } | null;
  energy?: Record<string, number | null> | null;
  trace_hash?: string;
}

/** Description of a channel. A value is an integer times the quantum; `count` is the number of values. */
export type Channel = [name: string, unit: string, quantum: number, count: number];

/** Amplitude and phase of a first harmonic, rad. */
type Harmonic = [amplitude: number, phase: number];

/** Signal of the second run that left its band around the signal of the first run. */
export interface Stray {
  signal: string; // name of the channel
  unit: string;
  ratio: number; // RMS of the difference, divided by the permitted RMS difference (the band)
  tolerance: number; // largest permitted difference at any time, in the unit of the signal
  from: number | null; // first time at which the difference exceeds the tolerance, s
}

/** Second run on the page, and its differences from the first run (report/page/page_overlay.h). */
export interface Overlay {
  labels: [own: string, second: string];
  folders: [own: string, second: string]; // names of the run folders; "" for a golden
  differs: string[]; // settings that differ
  strayed: string | null; // reason why the run failed against its golden; null on a page that compares two runs
  strays: Stray[];
  differences: Channel[]; // second run minus first run, a channel per stray signal
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
  outcome: string; // "done", "not run" for a robot that was only assembled, or the reason for an early end
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
  changes?: { t: number; text: string }[]; // changes of the run (section at), s, in words
  sensors?: { name: string; body: number; position: [number, number, number] }[]; // position in body axes, m
  overlay?: Overlay;
}
