// Film of a run: frames of the 3D picture over the span of time of the plots, at the speed that the page plays with,
// encoded by the browser (WebCodecs). Every frame has its own time, so that a slow machine makes the same film.
import { ringLoad } from "../colour";
import type { Page } from "../page";
import type { View } from "../scene/view";
import { webm, type Frame } from "./webm";
import { paper, wordsOf, Writer } from "./words";

const [width, height, perSecond, margin] = [1280, 720, 30, 28]; // px
const apart = 2 * perSecond; // frames from one key frame to the next
const codecs = { V_VP9: "vp09.00.31.08", V_VP8: "vp8" };
const most = 4; // frames that wait for the encoder

interface Shot {
  page: Page;
  view: View;
  rate: number;
}

/** Codec that this browser encodes, as WebM names it. */
async function codec(): Promise<[name: string, config: VideoEncoderConfig]> {
  for (const [name, codec] of Object.entries(codecs)) {
    const config = { codec, width, height, bitrate: 5e6, framerate: perSecond };
    const { supported } = await VideoEncoder.isConfigSupported(config);
    if (supported) return [name, config];
  }
  throw new Error("this browser encodes neither VP9 nor VP8");
}

/** Makes the film. `made` gets the share of the frames that are drawn. If it returns false, the film is null. */
export async function film(page: Page, view: View, made: (share: number) => boolean): Promise<Blob | null> {
  const { rate } = page.state;
  const [from, to] = page.state.span;
  const [name, config] = await codec();
  const frames: Frame[] = [];
  const wrong: Error[] = [];
  const encoder = new VideoEncoder({
    output: (chunk) => {
      const bytes = new Uint8Array(chunk.byteLength);
      chunk.copyTo(bytes);
      frames.push({ bytes, time: chunk.timestamp / 1000, key: chunk.type === "key" });
    },
    error: (e) => {
      wrong.push(e);
    },
  });
  encoder.configure(config);
  const on = paper(width, height);
  const count = Math.max(1, Math.round(((to - from) / rate) * perSecond));
  try {
    for (let k = 0; k < count; k++) {
      if (wrong.length) throw wrong[0];
      if (!made(k / count)) return null;
      const t = Math.min(from + (k * rate) / perSecond, to);
      draw(on, { page, view, rate }, t);
      const frame = new VideoFrame(on.canvas, { timestamp: Math.round((k * 1e6) / perSecond) });
      encoder.encode(frame, { keyFrame: k % apart === 0 });
      frame.close();
      // The page answers between two frames.
      do await new Promise((next) => setTimeout(next));
      while (encoder.encodeQueueSize > most && !wrong.length);
    }
    await encoder.flush();
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
  return webm(name, width, height, (1000 * count) / perSecond, frames);
}

function draw(on: CanvasRenderingContext2D, { page, view, rate }: Shot, t: number): void {
  const { ink, recording } = page;
  on.drawImage(view.picture(t, width, height), 0, 0);
  const writer = new Writer(on, ink);
  let y = margin;
  for (const { colour, whose, said } of wordsOf()) {
    const words = `${whose && `${whose}: `}${said}`;
    on.fillStyle = ink.panel;
    on.fillRect(margin, y, Math.min(writer.width(words, 30, true) + 40, width - 2 * margin), 52);
    on.fillStyle = colour;
    on.fillRect(margin, y, 10, 52);
    writer.write(words, [margin + 26, y + 10], 30, { bold: true, width: width - 2 * margin - 40 });
    y += 62;
  }
  const foot = height - margin - 24;
  writer.write(`${recording.meta.name} · gaitlab`, [margin, foot], 20, { colour: ink.muted });
  const clock = `${t.toFixed(2)} s${rate === 1 ? "" : `, ${rate}×`}`;
  writer.write(clock, [width - margin - writer.width(clock, 26, true), foot - 4], 26, { bold: true });
  const legend = document.getElementById("legend-load")!;
  if (!legend.hidden) ramp(on, writer, legend.textContent.trim(), foot - 38);
}

/** Legend of the colours of loads. */
function ramp(on: CanvasRenderingContext2D, writer: Writer, words: string, y: number): void {
  const length = 90; // px
  for (let x = 0; x < length; x++) {
    const [r, g, b] = ringLoad(writer.ink.theme, x / length);
    on.fillStyle = `rgb(${r} ${g} ${b})`;
    on.fillRect(margin + x, y + 5, 1, 14);
  }
  writer.write(words, [margin + length + 12, y], 18, { colour: writer.ink.muted });
}
