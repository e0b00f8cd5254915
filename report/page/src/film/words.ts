// Words of the page's cards on a picture: verdict, name of the run, and text in lines.
import type { Ink } from "../colour";

/** Words of a verdict, one for each run of the page. */
export interface Words {
  colour: string;
  whose: string;
  said: string;
  reason: string;
  facts: [name: string, value: string][];
}

/** Words of the page's cards, without commands. */
export function wordsOf(): Words[] {
  return [...document.querySelectorAll<HTMLElement>(".verdict")].map((card) => {
    const text = (part: string) => {
      const of = card.querySelector(`.${part}`)!.cloneNode(true) as HTMLElement;
      for (const command of of.querySelectorAll(".by")) command.remove();
      return of.textContent.trim();
    };
    return {
      colour: getComputedStyle(card.querySelector(".badge")!).backgroundColor,
      whose: card.querySelector(".whose b")?.textContent ?? "",
      said: text("said"),
      reason: text("reason"),
      facts: [...card.querySelectorAll(".facts > div")].map((one): [string, string] => [
        one.querySelector("dt")!.textContent,
        one.querySelector("dd")!.textContent,
      ]),
    };
  });
}

/** Canvas of this size, and its drawing context. */
export function paper(width: number, height: number): CanvasRenderingContext2D {
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  return canvas.getContext("2d", { alpha: false })!;
}

export class Writer {
  private readonly family = getComputedStyle(document.body).fontFamily;

  constructor(
    private readonly on: CanvasRenderingContext2D,
    readonly ink: Ink,
  ) {}

  /** Writes text in at most `most` lines of a width, px, from the top `y` on. Returns the top of what follows. */
  write(
    text: string,
    [x, y]: [number, number],
    size: number,
    style: { colour?: string; bold?: boolean; width?: number; most?: number } = {},
  ): number {
    const { on, ink } = this;
    const { colour = ink.ink, bold = false, width = Infinity, most = 1 } = style;
    on.font = `${bold ? "600 " : ""}${size}px ${this.family}`;
    on.fillStyle = colour;
    on.textBaseline = "top";
    const lines = this.lines(text, width, most);
    lines.forEach((line, k) => on.fillText(line, x, y + 1.3 * size * k));
    return y + 1.3 * size * lines.length;
  }

  /** Width of text of this size, px. */
  width(text: string, size: number, bold = false): number {
    this.on.font = `${bold ? "600 " : ""}${size}px ${this.family}`;
    return this.on.measureText(text).width;
  }

  private lines(text: string, width: number, most: number): string[] {
    const fits = (line: string) => this.on.measureText(line).width <= width;
    const made: string[] = [""];
    for (const word of text.split(/\s+/)) {
      const longer = `${made[made.length - 1]} ${word}`.trim();
      if (fits(longer) || !made[made.length - 1]) made[made.length - 1] = longer;
      else made.push(word);
    }
    if (made.length <= most) return made;
    const kept = made.slice(0, most);
    while (kept[most - 1] && !fits(`${kept[most - 1]} …`)) kept[most - 1] = kept[most - 1].replace(/\s*\S+$/, "");
    kept[most - 1] += " …";
    return kept;
  }
}
