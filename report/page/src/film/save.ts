// Buttons that save a picture or a film of the page as a file.
import { element, make } from "../dom";
import type { Page } from "../page";
import { card } from "./card";
import { film } from "./film";

/** Connects the buttons. Without a 3D picture they are hidden. */
export function saves(page: Page): void {
  const { view } = page.stage;
  const button = element<HTMLButtonElement>("film");
  element("card").hidden = !view;
  button.hidden = !view || !page.recording.ran;
  if (!view) return;
  element("card").addEventListener("click", () => void save(page, ".png", () => card(page, view)));
  if (!("VideoEncoder" in window)) {
    button.disabled = true;
    button.title = "This browser cannot encode films; Chromium, Firefox from 130 and Safari from 16.4 can";
    return;
  }
  let state: "off" | "on" | "stop" = "off";
  const filming = (share: number) => {
    button.textContent = `Stop (${Math.floor(100 * share)} %)`;
    return state === "on";
  };
  button.addEventListener("click", () => {
    const starts = state === "off";
    state = starts ? "on" : "stop";
    if (!starts) return;
    void save(page, ".webm", () => film(page, view, filming)).then(() => {
      state = "off";
      button.textContent = "Film";
    });
  });
}

/** Makes a file while the page does not play. Afterwards the page shows what it showed before. */
async function save(page: Page, ending: string, made: () => Promise<Blob | null>): Promise<void> {
  const wrong = element("unsaved");
  wrong.hidden = true;
  const picture = element<HTMLButtonElement>("card");
  picture.disabled = true;
  page.play(false);
  page.stage.freeze(true);
  try {
    const file = await made();
    if (file) download(file, page.recording.meta.name.replace(/[^\w.-]+/g, "-") + ending);
  } catch (e) {
    wrong.textContent = `The ${ending} file could not be made: ${e instanceof Error ? e.message : String(e)}.`;
    wrong.hidden = false;
  }
  picture.disabled = false;
  page.stage.freeze(false);
  page.stage.view?.resize();
  page.seek(page.state.t);
}

/** Saves a file. Its address is valid until the page is closed, because no event tells when the file is written. */
function download(file: Blob, name: string): void {
  const link = make("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
}
