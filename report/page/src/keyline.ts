// Legend of a drawing: its marks and colours.
import { element, make } from "./dom";

export type Key = [kind: string, colour: string, words: string];

/** Fills the line under a plot; an entry without words is left out. */
export function keys(id: string, entries: Key[]): void {
  element(id).replaceChildren(
    ...entries
      .filter(([, , words]) => words)
      .map(([kind, colour, words]) => {
        const key = make("span.k", words);
        if (kind) key.classList.add(kind);
        key.style.setProperty("--c", `var(${colour})`);
        return key;
      }),
  );
}
