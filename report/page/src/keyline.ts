// Legend under a drawing: the marks and colours, and their meaning.
import { element, make } from "./dom";

export type Key = [kind: string, colour: string, words: string];

/** Replaces the legend in the element `id`. Entries without words are omitted. */
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
