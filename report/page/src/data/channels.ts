// Decoder of the packed channels. A channel is stored as first differences of integers, in zigzag and LEB128 encoding.
// The channels follow one another and are compressed together by zlib, then encoded in base64.
import type { Channel } from "./format";

export type Values = Float32Array;

/** Channels by name. A value is the stored integer times the quantum of its channel. */
export function unpack(channels: readonly Channel[], bytes: Uint8Array): Map<string, Values> {
  const found = new Map<string, Values>();
  let at = 0;
  for (const [name, , quantum, count] of channels) {
    const values = new Float32Array(count);
    let sum = 0;
    for (let i = 0; i < count; i++) {
      // The code multiplies instead of shifting, because << is limited to 32 bits.
      let zigzag = 0;
      let shift = 1;
      let byte: number;
      do {
        if (at === bytes.length) throw new Error(`its data end within channel ${name}`);
        byte = bytes[at++];
        zigzag += (byte & 127) * shift;
        shift *= 128;
      } while (byte > 127);
      sum += zigzag % 2 ? -(zigzag + 1) / 2 : zigzag / 2;
      values[i] = sum * quantum;
    }
    found.set(name, values);
  }
  if (at !== bytes.length) throw new Error(`its data have ${bytes.length - at} bytes too many`);
  return found;
}

export async function inflate(base64: string): Promise<Uint8Array> {
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
