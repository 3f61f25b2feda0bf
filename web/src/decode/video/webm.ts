// Reads WebM files with one VP9 video (RFC 9559), as far as videos of sequences need them (docs/formats/video.md).
// src/video/webm.h does the same; vectors/video-1 binds both.

import { DecodeError } from "../decodeError.ts";

export interface WebmVideo {
  readonly width: number;
  readonly height: number;
  readonly packets: readonly VideoPacket[];
}

/** An encoded image. */
export interface VideoPacket {
  /** A part of the file. */
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Whether it can be decoded without those before it. */
  readonly isKey: boolean;
}

export const maxVideoBytes = 2 ** 28;
export const maxVideoEdge = 16384;
const maxPackets = 2 ** 20;

const ids = {
  ebml: 0x1a45dfa3,
  segment: 0x18538067,
  tracks: 0x1654ae6b,
  trackEntry: 0xae,
  trackNumber: 0xd7,
  trackType: 0x83,
  codecId: 0x86,
  video: 0xe0,
  pixelWidth: 0xb0,
  pixelHeight: 0xba,
  cluster: 0x1f43b675,
  simpleBlock: 0xa3,
  blockGroup: 0xa0,
  block: 0xa1,
} as const;

/** Elements whose content is read element by element. */
const entered: ReadonlySet<number> = new Set([
  ids.segment,
  ids.tracks,
  ids.trackEntry,
  ids.video,
  ids.cluster,
  ids.blockGroup,
]);

interface Track {
  number: number;
  type: number;
  codec: string;
  width: number;
  height: number;
}

/** Safe for untrusted bytes. Throws DecodeError. */
export function readWebm(bytes: Uint8Array<ArrayBuffer>): WebmVideo {
  if (bytes.length > maxVideoBytes)
    throw new DecodeError("limit", `has ${bytes.length} bytes; videos of up to ${maxVideoBytes} are read`);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 4 || view.getUint32(0) !== ids.ebml) throw new DecodeError("malformed", "is no WebM video");
  return new Reader(bytes).read();
}

/**
 * Reads elements one behind the other. Those whose content it needs it enters, and so needs no ends of them, which
 * files that were written while they were recorded do not state.
 */
class Reader {
  readonly #bytes: Uint8Array<ArrayBuffer>;
  readonly #packets: VideoPacket[] = [];
  #at = 0;
  #entry: Track | undefined;
  /** The video that is read: the first of the file. */
  #track: Track | undefined;

  constructor(bytes: Uint8Array<ArrayBuffer>) {
    this.#bytes = bytes;
  }

  read(): WebmVideo {
    while (this.#at < this.#bytes.length) this.#readElement();
    this.#finishTrack();
    if (this.#track === undefined) throw new DecodeError("malformed", "has no video track");
    if (this.#packets.length === 0) throw new DecodeError("truncated", "has no images");
    return { width: this.#track.width, height: this.#track.height, packets: this.#packets };
  }

  /**
   * An integer of one to eight bytes, whose leading zero bits state how many; undefined for one whose bits are all set.
   */
  #readNumber(maxLength: number, keepsMarker: boolean): number | undefined {
    const first = this.#bytes[this.#at];
    if (first === undefined) throw new DecodeError("truncated", "is cut");
    const length = Math.clz32(first) - 23;
    if (length > maxLength) throw new DecodeError("malformed", `has no element at byte ${this.#at}`);
    if (this.#bytes.length - this.#at < length) throw new DecodeError("truncated", "is cut");
    const mask = 2 ** (8 - length) - 1;
    let number = keepsMarker ? first : first & mask;
    let isAllSet = (first & mask) === mask;
    for (let i = 1; i < length; ++i) {
      const byte = this.#bytes[this.#at + i] ?? 0;
      number = number * 256 + byte;
      isAllSet &&= byte === 255;
    }
    this.#at += length;
    return isAllSet && !keepsMarker ? undefined : number;
  }

  #readElement(): void {
    const id = this.#readNumber(4, true) ?? 0;
    const size = this.#readNumber(8, false);
    if (size === undefined && id !== ids.segment && id !== ids.cluster)
      throw new DecodeError("malformed", "has an element without a size");
    if (size !== undefined && size > this.#bytes.length - this.#at) throw new DecodeError("truncated", "is cut");
    if (id === ids.trackEntry || id === ids.cluster) this.#finishTrack();
    if (id === ids.trackEntry) this.#entry = { number: 0, type: 0, codec: "", width: 0, height: 0 };
    if (entered.has(id)) return;
    const content = this.#bytes.subarray(this.#at, this.#at + (size ?? 0));
    this.#at += content.length;
    if (id === ids.simpleBlock || id === ids.block) this.#readBlock(content);
    else if (this.#entry) readTrackField(this.#entry, id, content);
  }

  #finishTrack(): void {
    const entry = this.#entry;
    this.#entry = undefined;
    if (entry?.type !== 1 || this.#track !== undefined) return;
    const { codec, width, height } = entry;
    if (codec !== "V_VP9") throw new DecodeError("unsupported", "is no VP9: only lossless VP9 is read");
    if (width === 0 || height === 0) throw new DecodeError("malformed", "has images without a size");
    if (width > maxVideoEdge || height > maxVideoEdge)
      throw new DecodeError(
        "limit",
        `has images of ${width} x ${height} pixels; up to ${maxVideoEdge} x ${maxVideoEdge} are read`,
      );
    this.#track = entry;
  }

  #readBlock(content: Uint8Array<ArrayBuffer>): void {
    const [track = 0, , , flags = 0] = content;
    if (content.length < 4 || (track & 0x80) === 0) throw new DecodeError("malformed", "has an image without a track");
    if ((track & 0x7f) !== this.#track?.number) return;
    if ((flags & 0x06) !== 0) throw new DecodeError("unsupported", "has several images in a block");
    if (this.#packets.length === maxPackets) throw new DecodeError("limit", `has more than ${maxPackets} images`);
    const bytes = content.subarray(4);
    this.#packets.push({ bytes, isKey: isKeyPacket(bytes, this.#packets.length) });
  }
}

function readTrackField(track: Track, id: number, content: Uint8Array): void {
  switch (id) {
    case ids.trackNumber:
      track.number = integerOf(content);
      break;
    case ids.trackType:
      track.type = integerOf(content);
      break;
    case ids.codecId:
      track.codec = String.fromCharCode(...content.subarray(0, 32));
      break;
    case ids.pixelWidth:
      track.width = integerOf(content);
      break;
    case ids.pixelHeight:
      track.height = integerOf(content);
      break;
    default:
  }
}

function integerOf(content: Uint8Array): number {
  if (content.length > 8) throw new DecodeError("malformed", "has a number of more than eight bytes");
  return content.reduce((number, byte) => number * 256 + byte, 0);
}

/** VP9 bitstream specification, 6.2: frame marker 2, profile 1, no show_existing_frame, frame type. */
function isKeyPacket([first = 0]: Uint8Array, number: number): boolean {
  if ((first & 0xf8) !== 0xa0)
    throw new DecodeError("unsupported", `has no VP9 of profile 1, which has RGB, in image ${number}`);
  return (first & 0x04) === 0;
}
