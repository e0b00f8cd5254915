// Envelope of a motor: largest and least torque over speed, interpolated between samples.
import type { Motor } from "./format";

export const limited = (motor: Motor | null): motor is Motor => !!motor && motor.speed.length > 0;

function between(speed: readonly number[], torque: readonly number[], w: number): number {
  const last = speed.length - 1;
  if (w <= speed[0]) return torque[0];
  if (w >= speed[last]) return torque[last];
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (speed[middle] <= w) low = middle;
    else high = middle;
  }
  return torque[low] + ((torque[high] - torque[low]) * (w - speed[low])) / (speed[high] - speed[low]);
}

export const most = (motor: Motor, w: number): number => between(motor.speed, motor.most, w);
export const least = (motor: Motor, w: number): number => between(motor.speed, motor.least, w);

/** Torque at speed w as a share, 0 to 1, of the torque that the motor can reach at w in the same direction. */
export function use(motor: Motor, w: number, torque: number): number {
  const available = torque < 0 ? -least(motor, w) : most(motor, w);
  if (torque === 0) return 0;
  return available > 0 ? Math.min(Math.abs(torque) / available, 1) : 1;
}
