// Card of a run: a PNG with the robot at the time shown and the words of the verdict, for a message or a slide.
import type { Page } from "../page";
import type { View } from "../scene/view";
import { paper, wordsOf, Writer } from "./words";

const [width, height, left, margin] = [1200, 630, 500, 36]; // px; left: width of the words

export function card(page: Page, view: View): Promise<Blob> {
  const on = paper(width, height);
  const { ink, recording, state } = page;
  on.drawImage(view.picture(state.t, width - left, height), left, 0);
  on.fillStyle = ink.panel;
  on.fillRect(0, 0, left, height);
  const writer = new Writer(on, ink);
  const room = left - 2 * margin;
  const cards = wordsOf();
  const [large, small] = cards.length > 1 ? [28, 17] : [40, 21];
  let y = writer.write(recording.meta.name, [margin, margin], 22, { colour: ink.muted, width: room }) + 14;
  for (const { colour, whose, said, reason, facts } of cards) {
    on.fillStyle = colour;
    on.fillRect(0, y, 12, 1.2 * large);
    if (whose) y = writer.write(whose, [margin, y], small, { colour: ink.muted, width: room });
    y = writer.write(said, [margin, y], large, { bold: true, width: room, most: 3 }) + 8;
    y =
      writer.write(reason, [margin, y], small, { colour: ink.ink2, width: room, most: cards.length > 1 ? 4 : 7 }) + 14;
    for (const [name, value] of facts.slice(0, cards.length > 1 ? 1 : 3)) {
      const from = margin + Math.max(170, writer.width(`${name}  `, 18));
      writer.write(name, [margin, y + 3], 18, { colour: ink.muted });
      y = writer.write(value, [from, y], 21, { bold: true, width: left - margin - from, most: 2 }) + 4;
    }
    y += 16;
  }
  const when = recording.ran ? `${state.t.toFixed(2)} s` : "";
  writer.write(`gaitlab${when && ` · the picture: ${when}`}`, [margin, height - margin - 18], 18, {
    colour: ink.muted,
  });
  return new Promise((done, failed) => {
    on.canvas.toBlob((made) => (made ? done(made) : failed(new Error("the browser made no PNG"))), "image/png");
  });
}
