// Controls of the page: buttons, keys, and the change of the theme for printing.
import type { Theme } from "./colour";
import { element } from "./dom";
import { saves } from "./film/save";
import type { Page } from "./page";
import type { Look } from "./scene/view";

export function controls(page: Page): void {
  buttons(page);
  addEventListener("keydown", (e) => press(page, e));
  print(page);
  saves(page);
}

const otherTheme = ({ ink }: Page): Theme => (ink.theme === "dark" ? "light" : "dark");

function buttons(page: Page): void {
  const on = (id: string, act: () => void) => element(id).addEventListener("click", act);
  on("theme", () => page.theme(otherTheme(page)));
  on("print", () => window.print());
  on("keys", () => {
    const list = element("keylist");
    list.hidden = !list.hidden;
    element("keys").setAttribute("aria-expanded", String(!list.hidden));
  });
  on("previous", () => page.choose(page.state.joint - 1));
  on("next", () => page.choose(page.state.joint + 1));
  element("joint").addEventListener("change", (e) => page.choose(Number((e.target as HTMLSelectElement).value)));
}

function press(page: Page, e: KeyboardEvent): void {
  const target = e.target as HTMLElement;
  if (target.matches("select, input:not(#time)") || e.ctrlKey || e.metaKey || e.altKey) return;
  const act = keys(page, e.shiftKey)[e.key.length === 1 ? e.key.toLowerCase() : e.key];
  if (!act || (e.key === " " && target.matches("button, summary"))) return;
  e.preventDefault();
  act();
}

/** Actions by key. The arrow keys move by 0.1 s if `coarse` is true, otherwise by one row. */
function keys(page: Page, coarse: boolean): Record<string, (() => void) | undefined> {
  const { state, recording, stage } = page;
  const step = coarse ? 0.1 : recording.meta.period;
  const look = (from: Look) => () => stage.view?.look(from);
  const click = (id: string) => () => {
    if (!element(id).hidden) element(id).click();
  };
  return {
    " ": () => page.play(!state.playing),
    ArrowLeft: () => page.goTo(state.t - step),
    ArrowRight: () => page.goTo(state.t + step),
    Home: () => page.goTo(0),
    End: () => page.goTo(recording.end),
    "[": () => page.choose(state.joint - 1),
    "]": () => page.choose(state.joint + 1),
    1: look("iso"),
    2: look("side"),
    3: look("top"),
    4: look("front"),
    j: () => stage.frame(state.joint),
    x: click("next-problem"),
    f: click("follow"),
    l: click("tint"),
    c: click("forces"),
    b: click("balance-marks"),
    t: click("travel"),
    n: click("faces"),
    a: click("axes"),
    k: click("rings"),
    d: click("theme"),
    z: () => page.zoom(null),
    p: click("align"),
    "?": click("keys"),
  };
}

/** Switches to the light theme while the browser prints, and replaces the 3D view by a picture. */
function print(page: Page): void {
  let before: Theme | null = null;
  addEventListener("beforeprint", () => {
    if (before) return;
    before = page.ink.theme;
    page.play(false);
    document.documentElement.classList.add("printing");
    page.theme("light");
    page.stage.freeze(true);
  });
  addEventListener("afterprint", () => {
    if (!before) return;
    document.documentElement.classList.remove("printing");
    page.stage.freeze(false);
    page.theme(before);
    before = null;
  });
}
