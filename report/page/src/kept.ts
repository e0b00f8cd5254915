// State of the page that a renewed page keeps, in one object of the session.
import type { Theme } from "./colour";
import type { Span } from "./data/recording";
import type { Page } from "./page";
import type { Pose } from "./scene/view";

export interface Kept {
  run: number; // run for which the page was loaded again
  theme: Theme;
  values: Record<string, string>; // selected value by the id of a list
  pressed: string[]; // ids of the buttons that are on
  check: string | null; // id of the opened check
  joint: string | null;
  stretch: string | null; // length of the plots that is selected; null for a span that the reader drew
  span: Span;
  t: number;
  pose: Pose | null;
  playing: boolean;
}

const name = `gaitlab ${location.pathname}`;
const lists = "#what, #order, #side, #speed";
const all = <E extends HTMLElement>(selector: string) => [...document.querySelectorAll<E>(selector)];

/** Writes the state of the page for the next page at this address, which shows a run. */
export function keep({ state, recording, ink, stage }: Page, run: number): void {
  const kept: Kept = {
    run,
    theme: ink.theme,
    values: Object.fromEntries(all<HTMLSelectElement>(lists).map(({ id, value }) => [id, value])),
    pressed: all('.tools [aria-pressed="true"]').map(({ id }) => id),
    check: all('#checks [data-check]:has([aria-expanded="true"])')[0]?.dataset.check ?? null,
    joint: recording.meta.joints[state.joint]?.name ?? null,
    stretch: all('[data-stretch][aria-pressed="true"]')[0]?.dataset.stretch ?? null,
    span: [...state.span],
    t: state.t,
    pose: stage.view?.kept() ?? null,
    playing: state.playing,
  };
  try {
    sessionStorage.setItem(name, JSON.stringify(kept));
  } catch {
    // Without storage the page begins anew.
  }
}

/** Shows the state that the page before wrote, once; null if there is none. */
export function restore(page: Page): Kept | null {
  let kept: Kept | null = null;
  try {
    kept = JSON.parse(sessionStorage.getItem(name) ?? "null") as Kept | null;
    sessionStorage.removeItem(name);
  } catch {
    // as above
  }
  if (kept) show(page, kept);
  return kept;
}

function show(page: Page, { theme, values, pressed, check, joint, stretch, span, t, pose, playing }: Kept): void {
  page.theme(theme);
  for (const list of all<HTMLSelectElement>(lists)) {
    if (![...list.options].some((o) => o.value === values[list.id])) continue;
    list.value = values[list.id];
    list.dispatchEvent(new Event("change"));
  }
  for (const button of all(".tools [aria-pressed]:not([hidden])")) {
    if (pressed.includes(button.id) !== (button.getAttribute("aria-pressed") === "true")) button.click();
  }
  // A check shows its own joint and time; those of the reader follow.
  if (check) all(`#checks [data-check="${check}"]`)[0]?.click();
  const number = page.recording.meta.joints.findIndex((j) => j.name === joint);
  if (number >= 0 && number !== page.state.joint) page.choose(number);
  if (stretch) all(`[data-stretch="${stretch}"]`)[0]?.click();
  else page.zoom(span);
  page.goTo(t);
  if (pose) page.stage.view?.pose(pose);
  if (playing) page.play(true);
}
