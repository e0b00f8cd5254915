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

/** Button that looks like a link. A click calls `act`, and then the listeners of the elements around the button. */
export function link(text: string, act?: () => void): HTMLButtonElement {
  const made = make("button.link", text);
  made.type = "button";
  if (act) made.addEventListener("click", act);
  return made;
}

/** Head of a table with the names and units of its columns. */
export const tableHead = (...columns: (readonly [name: string, unit?: string])[]): HTMLElement =>
  make(
    "thead",
    make("tr", ...columns.map(([name, unit]) => make("th", name, ...(unit ? [make("small", ` ${unit}`)] : [])))),
  );

export function rowHead(child: Child): HTMLTableCellElement {
  const made = make("th", child);
  made.scope = "row";
  return made;
}

export function svg(tag: string, attributes: Record<string, number | string>, ...children: Child[]): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

export const icon = (paths: string, box = 16): SVGElement =>
  svg("svg", { viewBox: `0 0 ${box} ${box}`, "aria-hidden": "true" }, svg("path", { d: paths }));

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
