// WebM file of encoded frames: EBML elements (RFC 8794) of Matroska (RFC 9559), with cues, so that players can seek.

/** Frame of an encoder. Its time is in ms from the start of the film. */
export interface Frame {
  bytes: Uint8Array<ArrayBuffer>;
  time: number;
  key: boolean;
}
type Bytes = Uint8Array<ArrayBuffer>;

const big = (n: number, length: number): Bytes =>
  Uint8Array.from({ length }, (_, k) => Math.floor(n / 256 ** (length - 1 - k)) % 256);
const lengthOf = (parts: Bytes[]): number => parts.reduce((sum, one) => sum + one.length, 0);

/** Element with its size in 8 bytes, so that no size depends on a value. */
function element(id: number, ...content: Bytes[][]): Bytes[] {
  const parts = content.flat();
  return [big(id, Math.ceil(Math.log2(id + 1) / 8)), Uint8Array.of(1, ...big(lengthOf(parts), 7)), ...parts];
}
const whole = (id: number, n: number): Bytes[] => element(id, [big(n, 8)]);
const text = (id: number, words: string): Bytes[] => element(id, [new TextEncoder().encode(words)]);
function real(id: number, x: number): Bytes[] {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, x);
  return element(id, [bytes]);
}

/** Frames up to the next key frame. Times in a cluster are relative to its start, with 16 bits. */
function cluster(frames: Frame[]): Bytes[] {
  const start = Math.round(frames[0].time);
  const blocks = frames.map(({ bytes, time, key }) =>
    element(0xa3, [Uint8Array.of(0x81, ...big(Math.round(time) - start, 2), key ? 0x80 : 0), bytes]),
  );
  return element(0x1f43b675, whole(0xe7, start), ...blocks);
}

/** A film of `duration` ms; the first frame is a key frame, and key frames are less than 32 s apart. */
export function webm(codec: string, width: number, height: number, duration: number, frames: Frame[]): Blob {
  const starts = frames.flatMap(({ key }, k) => (key ? [k] : []));
  const clusters = starts.map((from, k) => cluster(frames.slice(from, starts[k + 1])));
  const head = element(
    0x1a45dfa3,
    whole(0x4286, 1),
    whole(0x42f7, 1),
    whole(0x42f2, 4),
    whole(0x42f3, 8),
    text(0x4282, "webm"),
    whole(0x4287, 2),
    whole(0x4285, 2),
  );
  const about = element(
    0x1549a966,
    whole(0x2ad7b1, 1e6),
    real(0x4489, duration),
    text(0x4d80, "gaitlab"),
    text(0x5741, "gaitlab"),
  );
  const video = element(0xe0, whole(0xb0, width), whole(0xba, height));
  const track = element(0xae, whole(0xd7, 1), whole(0x73c5, 1), whole(0x83, 1), text(0x86, codec), video);
  const tracks = element(0x1654ae6b, track);
  const cues = (first: number): Bytes[] => {
    let at = first;
    const points = clusters.map((one, k) => {
      const place = element(0xb7, whole(0xf7, 1), whole(0xf1, at));
      at += lengthOf(one);
      return element(0xbb, whole(0xb3, Math.round(frames[starts[k]].time)), place);
    });
    return element(0x1c53bb6b, ...points);
  };
  const before = lengthOf(about) + lengthOf(tracks) + lengthOf(cues(0));
  const segment = element(0x18538067, about, tracks, cues(before), ...clusters);
  return new Blob([...head, ...segment], { type: "video/webm" });
}
