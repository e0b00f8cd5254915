// Loads of the joints at each row: torque as a share of the limit of the motor, current, tracking error.
import type { Values } from "./channels";
import type { Motor } from "./format";
import { limited, use } from "./motor";
import type { Recording } from "./recording";

export type Quantity = "use" | "torque" | "current" | "error";

export class Loads {
  /** Largest torque of each joint in the judged window, N m. */
  readonly peaks: number[];
  readonly peak: number;
  /** Largest value of `share` of all joints at each row. */
  readonly worst: Values;
  /** True if shares refer to the limits of the motors, false if shares refer to the largest torque of the run. */
  readonly limited: boolean;
  private readonly cache = new Map<string, Values>();

  constructor(private readonly recording: Recording) {
    const { joints } = recording.meta;
    const from = recording.judged;
    // The limits depend on the speed. Without recorded speeds, shares of the limits cannot be computed.
    this.limited = recording.any("speed") && recording.any("torque") && joints.some((_, j) => limited(this.motor(j)));
    this.peaks = joints.map((_, j) => largest(recording.channel(`joint.${j}.torque`), from));
    this.peak = Math.max(...this.peaks, 1e-9);
    this.worst = new Float32Array(recording.rows);
    joints.forEach((_, j) =>
      this.share(j).forEach((x, i) => {
        if (x > this.worst[i]) this.worst[i] = x;
      }),
    );
  }

  motor(joint: number): Motor | null {
    const { joints, motors } = this.recording.meta;
    const m = joints[joint]?.motor;
    return m === null || m === undefined ? null : (motors[m] ?? null);
  }

  /** Torque as a share, 0 to 1, of the torque available at the speed, or of the largest torque; see `limited`. */
  share(joint: number): Values {
    return this.of("use", joint);
  }

  shareAt(joint: number, t: number): number {
    return this.recording.at(this.share(joint), t);
  }

  /** Joint, value and time of the largest share in the judged window. */
  get hardest(): { joint: number; share: number; t: number } {
    const { recording } = this;
    const found = { joint: 0, share: -1, t: 0 };
    recording.meta.joints.forEach((_, joint) => {
      const shares = this.share(joint);
      for (let i = recording.judged; i < shares.length; i++) {
        if (shares[i] > found.share) Object.assign(found, { joint, share: shares[i], t: recording.times[i] });
      }
    });
    return found;
  }

  /** Value of the quantity that `of` scales to 1, in the unit of the quantity. */
  scale(quantity: Quantity): number {
    const { recording } = this;
    if (quantity === "torque") return this.peak;
    if (quantity === "error") {
      return Math.max(
        0.2,
        ...recording.meta.verdict.checks.filter((c) => c.id === "tracking").map((c) => c.limit ?? 0),
      );
    }
    if (quantity === "current") {
      return Math.max(...recording.meta.motors.map((m) => m.current ?? 0)) || this.largestCurrent();
    }
    return 1;
  }

  of(quantity: Quantity, joint: number): Values {
    const key = `${quantity}/${joint}`;
    const known = this.cache.get(key);
    if (known) return known;
    const made = this.compute(quantity, joint);
    this.cache.set(key, made);
    return made;
  }

  private compute(quantity: Quantity, joint: number): Values {
    const { recording } = this;
    const one = (name: string) => recording.channel(`joint.${joint}.${name}`);
    const out = new Float32Array(recording.rows);
    const torque = one("torque");
    if (quantity === "use") {
      const motor = this.motor(joint);
      const speed = one("speed");
      if (this.limited && limited(motor)) return out.map((_, i) => use(motor, speed[i], torque[i]));
      return this.limited ? out : out.map((_, i) => Math.abs(torque[i]) / this.peak);
    }
    const scale = this.scale(quantity);
    const setpoint = one("setpoint");
    const angle = one("angle");
    const values = one(quantity);
    if (quantity === "error" && !recording.has(`joint.${joint}.setpoint`)) return out;
    if (quantity === "error") return out.map((_, i) => Math.abs(setpoint[i] - angle[i]) / scale);
    return out.map((_, i) => Math.abs(values[i]) / scale);
  }

  private largestCurrent(): number {
    return Math.max(
      1e-9,
      ...this.recording.meta.joints.map((_, j) => largest(this.recording.channel(`joint.${j}.current`))),
    );
  }
}

export function largest(values: Values, from = 0): number {
  let most = 0;
  for (let i = from; i < values.length; i++) most = Math.max(most, Math.abs(values[i]));
  return most;
}
