// Elements of page.html, and new ones; text is always text, never markup.

export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

type Child = Node | string;

/** make("td.num", "12") is <td class="num">12</td>. */
export function make<K extends keyof HTMLElementTagNameMap>(tag: K | `${K}.${string}`, ...children: Child[]): HTMLElementTagNameMap[K] {
  const [name, ...classes] = tag.split(".");
  const made = document.createElement(name as K);
  if (classes.length) made.className = classes.join(" ");
  made.append(...children);
  return made;
}

export function icon(paths: string, box = 16): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", `0 0 ${box} ${box}`);
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", paths);
  svg.append(path);
  return svg;
}

/** The panel around an element says why it shows nothing. */
export function empty(host: HTMLElement, why: string): void {
  const panel = host.closest<HTMLElement>(".panel") ?? host;
  panel.classList.add("is-empty");
  panel.querySelectorAll(".keyline, .note, .head select, .head label, .head button, .head .seg, .now").forEach((e) => e.remove());
  host.replaceChildren(make("p.empty", why));
}

export const panelOf = (id: string): HTMLElement => element(id).closest<HTMLElement>(".panel") ?? element(id);
