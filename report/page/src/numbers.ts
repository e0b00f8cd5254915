// Numbers as text: few digits, a real minus.

const space = "\u00a0"; // a number and its unit stay on one line
const minus = (text: string): string => text.replace("-", "−");

/** To `digits` significant digits, never with an exponent where a reader would stumble over it. */
export function number(x: number | null | undefined, digits = 3): string {
  if (x === null || x === undefined || !Number.isFinite(x)) return "–";
  if (x === 0) return "0";
  const rounded = Number(x.toPrecision(digits));
  return minus(Math.abs(rounded) >= 1e6 || Math.abs(rounded) < 1e-4 ? rounded.toExponential() : String(rounded));
}

export const fixed = (x: number, decimals: number): string => minus((Math.abs(x) < 0.5 * 10 ** -decimals ? 0 : x).toFixed(decimals));

export const percent = (share: number, digits = 3): string => `${number(100 * share, digits)}${space}%`;

/** Value with its unit; "" is a share, which reads in percent; small lengths read in mm. */
export function quantity(x: number | null, unit: string): string {
  if (x === null || !Number.isFinite(x)) return "–";
  if (unit === "") return percent(x);
  if (unit === "m" && Math.abs(x) < 0.1) return `${number(1000 * x)}${space}mm`;
  return `${number(x)}${space}${unit.replace(" ", space)}`;
}

export function span(from: number, to: number): string {
  return to - from > 1e-6 ? `${fixed(from, 2)} to ${fixed(to, 2)}${space}s` : `${fixed(from, 2)}${space}s`;
}

export const plural = (n: number, noun: string): string => `${n} ${noun}${n === 1 ? "" : "s"}`;
