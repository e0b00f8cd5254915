// Text of numbers and sentences. Numbers have few digits and a typographic minus; names keep their case.

const space = "\u00a0"; // no-break space, which keeps a number and its unit on one line
const minus = (text: string): string => text.replace("-", "−");

/** Magnitudes, by unit, below which a value is written as 0, because it is a rounding error of simulation or page. */
const floors: Record<string, number> = {
  "": 1e-6,
  m: 1e-7,
  rad: 1e-4,
  "rad/s": 1e-5,
  "N m": 1e-6,
  N: 1e-5,
  A: 1e-6,
  V: 1e-6,
  J: 1e-7,
  W: 1e-6,
};
const floored = (x: number, unit: string): number => (Math.abs(x) < (floors[unit] ?? 0) ? 0 : x);

/** Number with `digits` significant digits. Magnitudes below 1e-4, or of 1e6 and above, have an exponent. */
export function number(x: number | null | undefined, digits = 3, unit?: string): string {
  if (x === null || x === undefined || !Number.isFinite(x)) return "–";
  const kept = unit === undefined ? x : floored(x, unit);
  if (kept === 0) return "0";
  const rounded = Number(kept.toPrecision(digits));
  return minus(
    Math.abs(rounded) >= 1e6 || Math.abs(rounded) < 1e-4 ? rounded.toExponential().replace("e+", "e") : String(rounded),
  );
}

export const fixed = (x: number, decimals: number): string =>
  minus((Math.abs(x) < 0.5 * 10 ** -decimals ? 0 : x).toFixed(decimals));

/** Number of decimals, at least two, that gives the number `peak` three significant digits. */
export const decimalsOf = (peak: number, unit: string): number =>
  floored(peak, unit) === 0 ? 2 : Math.max(2, Math.ceil(-Math.log10(peak)) + 1);

/** Largest number up to x that is 1, 2 or 5 times a power of ten. */
export function rounded(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  return ([5, 2, 1].find((m) => m * power <= x * (1 + 1e-9)) ?? 1) * power;
}

export const percent = (share: number, digits = 3): string => `${number(100 * floored(share, ""), digits)}${space}%`;

/** Value with its unit. Shares (unit "") are in percent, lengths below 0.1 m in mm, large energies in MJ or GJ. */
export function quantity(x: number | null, unit: string): string {
  if (x === null || !Number.isFinite(x)) return "–";
  if (unit === "") return percent(x);
  if (unit === "m" && Math.abs(x) < 0.1) return `${number(1000 * floored(x, unit))}${space}mm`;
  const [scale, prefix] =
    Math.abs(x) < 1e6 || !/^[JWN]/.test(unit) ? [1, ""] : Math.abs(x) < 1e9 ? [1e6, "M"] : [1e9, "G"];
  return `${number(floored(x, unit) / scale)}${space}${prefix}${unit.replace(" ", space)}`;
}

/** Time in s with two decimals, or with three decimals if the time is not a multiple of 10 ms. */
export const time = (t: number): string =>
  `${fixed(t, Math.abs(100 * t - Math.round(100 * t)) < 0.05 ? 2 : 3)}${space}s`;

export function span(from: number, to: number): string {
  if (!(to - from > 1e-6)) return time(from);
  const decimals = to - from < 0.1 ? 3 : 2;
  return `${fixed(from, decimals)} to ${fixed(to, decimals)}${space}s`;
}

export const plural = (n: number, noun: string): string => `${n} ${noun}${n === 1 ? "" : "s"}`;

/** Text with a capital at the start, unless the text starts with a name (`m3/active`, `m5's dock`). */
export const capital = (text: string): string =>
  /^\S*[\d/]/.test(text) ? text : text.charAt(0).toUpperCase() + text.slice(1);
export const sentence = (text: string): string => (text ? capital(text) + (/[.!?]$/.test(text) ? "" : ".") : "");
/**
 * A text as sentences, which end at its semicolons. The first sentence has at most 25 words if it has a comma, colon or
 * bracket at which it can end before.
 */
export function sentences(text: string): string[] {
  const [first, ...rest] = text.split(/; (?:and )?/);
  const parts = first.split(/(?<=[,:]) /);
  const long = (kept: string[]) => kept.join(" ").split(" ").length > 25;
  let kept = parts;
  while (kept.length > 1 && long(kept)) kept = kept.slice(0, -1);
  const cut = parts.slice(kept.length).join(" ");
  return [kept.join(" ").replace(/[,:]$/, ""), ...(cut ? [cut] : []), ...rest].map(sentence);
}
/** Title for use within a sentence: an initial capital becomes lower case. */
export const inSentence = (title: string): string =>
  /^[A-Z][a-z]/.test(title) ? title[0].toLowerCase() + title.slice(1) : title;
