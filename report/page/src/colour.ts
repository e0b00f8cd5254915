// Colours of loads and differences, from the palette of Okabe and Ito that the figures use (report/plot/svg.h),
// darkened for contrast. style.css contains all other colours.

export type Theme = "light" | "dark";
export type Rgb = [number, number, number];

const names = [
  "ink",
  "ink2",
  "muted",
  "line",
  "grid",
  "track",
  "panel",
  "accent",
  "hatch",
  "cloud",
  "veil",
  "band",
  "blue",
  "vermillion",
  "green",
  "orange",
  "sky",
  "purple",
  "fail",
] as const;

/** Theme of the page, and the colours of style.css that drawings use. */
export type Ink = { theme: Theme } & Record<(typeof names)[number], string>;

export function inkOf(page: HTMLElement): Ink {
  const style = getComputedStyle(page);
  const colours = Object.fromEntries(names.map((n) => [n, style.getPropertyValue(`--${n}`).trim()]));
  return { theme: page.dataset.theme === "dark" ? "dark" : "light", ...colours } as Ink;
}

type Ramp = [at: number, colour: Rgb][];
const ramps: Record<Theme, Ramp> = {
  light: [
    [0, [236, 239, 242]],
    [0.25, [254, 226, 178]],
    [0.5, [252, 178, 92]],
    [0.8, [232, 96, 34]],
    [1, [208, 22, 52]],
  ],
  dark: [
    [0, [33, 39, 46]],
    [0.25, [92, 62, 30]],
    [0.5, [176, 98, 24]],
    [0.8, [232, 104, 38]],
    [1, [255, 158, 122]],
  ],
};

/**
 * Colours of the loads in the 3D picture, next to bodies of any colour. Every colour has a contrast of at least 3 with
 * the rim around it, and the rim with every body (tests/page/page_test.mjs).
 */
const rings: Record<Theme, Ramp> = {
  light: ramps.light,
  dark: [
    [0, [104, 114, 124]],
    [0.25, [160, 110, 54]],
    [0.5, [212, 122, 34]],
    [0.8, [246, 136, 70]],
    [1, [255, 196, 172]],
  ],
};
export const rim: Rgb = [12, 16, 20];

/** Colours of the bodies, of their edges and of the selection in the 3D picture. */
export const bodyColours = {
  light: {
    ghost: 0x8f4a86,
    active: 0x6fb9e3,
    passive: 0xe8ab3a,
    other: 0x98a1a9,
    edge: 0x27313a,
    shadow: 0xd0d7dd,
    accent: 0x0b5f9e,
  },
  dark: {
    ghost: 0xe39cc1,
    active: 0x4b97c6,
    passive: 0xc98d22,
    other: 0x7b858e,
    edge: 0x05080b,
    shadow: 0x090c0f,
    accent: 0x8fd0ff,
  },
};

/** Colour of a share of a limit, 0 to 1. The lightness is monotonic, so that the colours are also readable in grey. */
export const load = (theme: Theme, share: number): Rgb => between(ramps[theme], share);

/** Colour of a share of a limit in the 3D picture, 0 to 1. */
export const ringLoad = (theme: Theme, share: number): Rgb => between(rings[theme], share);

function between(ramp: Ramp, share: number): Rgb {
  const x = Math.min(Math.max(share, 0), 1);
  let k = 1;
  while (k < ramp.length - 1 && ramp[k][0] < x) k++;
  const [x0, a] = ramp[k - 1];
  const [x1, b] = ramp[k];
  const f = (x - x0) / (x1 - x0);
  return a.map((v, c) => Math.round(v + (b[c] - v) * f)) as Rgb;
}

const ends: Record<Theme, [less: Rgb, none: Rgb, more: Rgb]> = {
  light: [
    [0, 92, 152],
    [241, 243, 245],
    [168, 48, 0],
  ],
  dark: [
    [120, 196, 246],
    [28, 34, 40],
    [255, 148, 92],
  ],
};

/** Colour of a difference, -1 to 1. Its two hues can be distinguished with every kind of colour vision. */
export function difference(theme: Theme, x: number): Rgb {
  const [less, none, more] = ends[theme];
  const f = Math.min(Math.abs(x), 1) ** 0.8;
  const end = x < 0 ? less : more;
  return none.map((v, c) => Math.round(v + (end[c] - v) * f)) as Rgb;
}

export const css = (rgb: Rgb): string => `rgb(${rgb.join(",")})`;

const stops = (colours: Ramp): string =>
  `linear-gradient(90deg,${colours.map(([x, c]) => `${css(c)} ${100 * x}%`).join(",")})`;

/** CSS gradients of the colour scales, for legends. */
export const gradient = (theme: Theme): string => stops(ramps[theme]);
export const ringGradient = (theme: Theme): string => stops(rings[theme]);
export const differenceGradient = (theme: Theme): string =>
  stops([-1, -0.5, 0, 0.5, 1].map((x) => [(x + 1) / 2, difference(theme, x)]));
