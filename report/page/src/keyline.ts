// What the marks and colours of a drawing stand for.
import { element, make } from "./dom";

/** The line under a plot: mark, colour, words; without words it is left out. */
export function keys(id: string, entries: [kind: string, colour: string, words: string][]): void {
  element(id).replaceChildren(...entries.filter(([, , words]) => words).map(([kind, colour, words]) => {
    const key = make("span.k", words);
    if (kind) key.classList.add(kind);
    key.style.setProperty("--c", `var(${colour})`);
    return key;
  }));
}
