// Renewal of a page that `gaitlab watch` writes again after each change of the scenario. Such a page has the attribute
// data-watch with the number of its run, and stamp.svg beside it: its width is the number of the newest run in the
// folder, its height is 2 if the scenario has an error since; error.svg shows its message. (A page from a file may load
// pictures, but no data.)
import { make } from "./dom";
import type { Page } from "./page";
import { keep, restore } from "./kept";

const often = 500; // ms between looks at the stamp
const failed = "The scenario has an error. This is the run before it.";
const lost = "This page does not follow the scenario: stamp.svg, beside it, cannot be loaded.";

/** Checks regularly for a newer run, if the page is watched. Shows the view that the page had before. */
export function watch(page: Page): void {
  const run = Number(document.documentElement.dataset.watch ?? 0);
  if (!run) return;
  const kept = restore(page);
  const note = make("p.watch-note");
  note.setAttribute("role", "status");
  note.hidden = true;
  document.body.prepend(note);
  const words = make("span");
  const message = make("img"); // without it, the terminal has the message
  message.alt = "The terminal shows the message.";
  note.append(words, message);
  const say = (text: string) => {
    if (words.textContent !== text) words.textContent = text;
    note.hidden = !text;
    message.hidden = text !== failed;
    if (text === failed) message.src = `error.svg?${Date.now()}`;
  };
  const look = () => {
    const stamp = new Image();
    stamp.onload = () => {
      if (![run, kept?.run].includes(stamp.naturalWidth)) return renew(page, stamp.naturalWidth);
      say(stamp.naturalHeight < 2 ? "" : failed);
      setTimeout(look, often);
    };
    stamp.onerror = () => {
      say(lost); // the folder or the server has gone, or the page was moved
      setTimeout(look, often);
    };
    stamp.src = `stamp.svg?${Date.now()}`;
  };
  look();
}

function renew(page: Page, run: number): void {
  keep(page, run);
  location.reload();
}
