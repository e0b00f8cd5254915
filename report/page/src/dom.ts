// Access to elements of page.html, and creation of new ones. Text is never interpreted as markup.

export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

type Child = Node | string;

/** Creates an element: make("td.num", "12") is <td class="num">12</td>. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K | `${K}.${string}`,
  ...children: Child[]
): HTMLElementTagNameMap[K] {
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

/** Hides the panel that contains an element, and lists this panel with the reason at the end of the page. */
export function leaveOut(host: HTMLElement, why: string): void {
  const panel = host.closest<HTMLElement>(".panel");
  if (!panel) return;
  panel.hidden = true;
  const list = element("left-out");
  list.hidden = false;
  list.append(make("li", make("b", panel.querySelector("h3")?.textContent ?? ""), `: ${why}`));
}

export const panelOf = (id: string): HTMLElement => element(id).closest<HTMLElement>(".panel") ?? element(id);
