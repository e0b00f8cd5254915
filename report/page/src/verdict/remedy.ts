// Settings that would make the gait feasible, or the reserves of a feasible gait, and a map of the verdicts.
import { element, make, svg } from "../dom";
import type { Remedy, RemedyMap } from "../data/format";
import { capital, number, percent } from "../data/numbers";

type Setting = RemedyMap["frequency"];

const pitch = 20; // distance between the centres of adjacent cells, px
const left = 46;
const top = 4;
const bottom = 34;

export function remedy({ verdict, text, tones, runs, map }: Remedy): void {
  element("remedy-h").textContent = verdict === "feasible" ? "Reserves of this gait" : "Changes that make it feasible";
  element("remedy").append(...text.map((line, k) => make(`li.${tones[k]}`, capital(symbols(line)))));
  element("remedy-note").textContent =
    `${runs} runs; each line changes one setting.` +
    (map
      ? " Map: green gaits are feasible, stronger green is faster; the ring is this run; both axes are logarithmic."
      : "");
  if (map) element("remedy-map").append(drawn(map));
}

const symbols = (line: string): string => line.replaceAll("<=", "≤").replaceAll(">=", "≥");

function drawn(data: RemedyMap): SVGElement {
  const { factors, cells } = data;
  const size = factors.length * pitch;
  const feasible = cells.filter((c) => c.verdict === "feasible").length;
  const host = svg("svg", {
    viewBox: `0 0 ${left + size + 8} ${top + size + bottom + 4}`,
    width: left + size + 8,
    height: top + size + bottom + 4,
    role: "img",
    "aria-label": `Verdict over frequency and amplitude: ${feasible} of ${cells.length} gaits are feasible`,
    class: "remedy-map",
  });
  host.append(...cellsOf(data), ring(factors.length), ...axes(data, size));
  return host;
}

function cellsOf({ factors, cells, frequency, amplitude }: RemedyMap): SVGElement[] {
  const fastest = Math.max(...cells.map((c) => (c.verdict === "feasible" ? (c.speed ?? 0) : 0)), 1e-12);
  return cells.map(({ verdict, speed, margin, weakest }, k) => {
    const [x, y] = [k % factors.length, Math.floor(k / factors.length)];
    const share = verdict === "feasible" ? 0.3 + 0.7 * Math.max(0, (speed ?? 0) / fastest) : 0.4;
    const rect = svg("rect", {
      x: left + x * pitch,
      y: top + (factors.length - 1 - y) * pitch,
      width: pitch - 1,
      height: pitch - 1,
      class: verdict.replace(" ", "-"),
      "fill-opacity": share,
    });
    const numbers = [
      value(frequency, factors[x]),
      value(amplitude, factors[y]),
      verdict,
      ...(speed === null ? [] : [`${number(speed)} m/s`]),
      ...(margin === null ? [] : [`margin ${percent(margin)}`]),
      weakest,
    ];
    rect.append(svg("title", {}, numbers.join(", ")));
    return rect;
  });
}

const centre = (k: number): number => k * pitch + (pitch - 1) / 2;

const ring = (count: number): SVGElement =>
  svg("circle", { cx: left + centre((count - 1) / 2), cy: top + centre((count - 1) / 2), r: 5, class: "now" });

function axes({ factors, frequency, amplitude }: RemedyMap, size: number): SVGElement[] {
  const last = factors.length - 1;
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((share) => Math.round(share * last));
  const middle = top + size / 2;
  return [
    ...ticks.flatMap((k) => [
      svg("text", { x: left + centre(k), y: top + size + 14, "text-anchor": "middle" }, label(frequency, factors[k])),
      svg("text", { x: left - 5, y: top + 4 + centre(last - k), "text-anchor": "end" }, label(amplitude, factors[k])),
    ]),
    svg("text", { x: left + size / 2, y: top + size + 30, "text-anchor": "middle" }, `frequency, ${unit(frequency)}`),
    svg(
      "text",
      { x: 10, y: middle, "text-anchor": "middle", transform: `rotate(-90 10 ${middle})` },
      `amplitude, ${unit(amplitude)}`,
    ),
  ];
}

/** Value of a setting at a factor with its unit; the factor alone if the joints have different values. */
const value = ({ now, unit }: Setting, factor: number): string =>
  now === null ? `${number(factor)} times` : `${number(now * factor)} ${unit}`;

const unit = ({ now, unit: own }: Setting): string => (now === null ? "times its value" : own);
const label = ({ now }: Setting, factor: number): string => number((now ?? 1) * factor, 2);
