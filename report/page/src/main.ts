// Start of the page: reads its data, creates it, and draws its frames.
import { unpack } from "./data/channels";
import { bodyColours, rim, ringGradient, ringLoad } from "./colour";
import { controls } from "./controls";
import { make } from "./dom";
import { least, most, use } from "./data/motor";
import { capital, decimalsOf, percent, quantity } from "./data/numbers";
import { Page } from "./page";
import { Recording } from "./data/recording";
import { watch } from "./watch";

/** Interface for tests, and for the console of a browser. */
declare global {
  interface Window {
    gaitlab: {
      page: Page;
      unpack: typeof unpack;
      motor: { most: typeof most; least: typeof least; use: typeof use };
      texts: object;
      colours: object;
    };
  }
}

Recording.of(document)
  .then(([recording, second]) => {
    const page = new Page(recording, second);
    controls(page);
    const frame = (now: number) => {
      page.tick(now);
      requestAnimationFrame(frame);
    };
    window.gaitlab = {
      page,
      unpack,
      motor: { most, least, use },
      texts: { capital, decimalsOf, percent, quantity },
      colours: { bodyColours, ringGradient, ringLoad, rim },
    };
    requestAnimationFrame((now) => {
      frame(now);
      document.documentElement.dataset.ready = "";
      watch(page);
    });
  })
  .catch((e: unknown) => {
    const why = e instanceof Error ? e.message : String(e);
    const note = make(
      "p.noscript",
      `This page could not be drawn: ${why}. verdict.json and figure.svg are in the same folder.`,
    );
    note.setAttribute("role", "alert");
    document.body.prepend(note);
    throw e;
  });
