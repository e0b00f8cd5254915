import { unpack } from "./channels";
import { make } from "./dom";
import { least, most, use } from "./motor";
import { capital, decimalsOf, percent, quantity } from "./numbers";
import { Page } from "./page";
import { Recording } from "./recording";

/** What tests (and the curious, in the console) see. */
declare global {
  interface Window { gaitlab: { page: Page; unpack: typeof unpack; motor: { most: typeof most; least: typeof least; use: typeof use }; texts: object } }
}

Recording.of(document).then(([recording, second]) => {
  const page = new Page(recording, second), frame = (now: number) => {
    page.tick(now);
    requestAnimationFrame(frame);
  };
  window.gaitlab = { page, unpack, motor: { most, least, use }, texts: { capital, decimalsOf, percent, quantity } };
  requestAnimationFrame((now) => {
    frame(now);
    document.documentElement.dataset.ready = "";
  });
}).catch((e: unknown) => {
  const note = make("p.noscript", `This page could not be drawn: ${e instanceof Error ? e.message : String(e)}. verdict.json and figure.svg are beside it.`);
  note.setAttribute("role", "alert");
  document.body.prepend(note);
  throw e;
});
