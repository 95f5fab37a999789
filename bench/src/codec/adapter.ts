/** What the codec benchmark needs of a codec. */
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';

/** A frame, its points in file or raster order. */
export interface BenchCloud {
  name: string;
  /** 1 for height where there is no grid. */
  width: number;
  height: number;
  /** Of the depth camera; null where the file does not say. */
  intrinsics: { fx: number; fy: number; cx: number; cy: number } | null;
  /** x, y, z in metres and the attribute's bits, four words a point; NaN where nothing was measured. */
  frame: Float32Array;
  /** What the fourth word is: bytes R, G, B, 255 from the lowest, or an intensity 0…255. */
  attribute: 'colour' | 'intensity';
  /** `z`: optical axes. `range`: a sensor at the origin that looks about it. */
  depth: 'z' | 'range';
  /** Indices of the points that are finite and not at depth 0, ascending. */
  valid: Uint32Array;
}

/** What comes out of a decoder. */
export interface DecodedCloud {
  points: number;
  /** Metres, three a point. */
  metres: Float64Array | Float32Array;
  /** R, G, B a point, or the intensity thrice. */
  rgb: Uint8Array;
  /** Index in the frame of each point; null where the codec reorders: the nearest one is taken. */
  source: Uint32Array | null;
}

/** One codec at one setting, made ready for one cloud. */
export interface CodecRun extends Disposable {
  codec: string;
  setting: string;
  /** True where one lost packet loses the frame. */
  blob: boolean;
  /** Default true; false where the setting sends no colour. */
  hasColour?: boolean;
  /** The times of the same code outside WASM. */
  native?(rounds: number): { encodeMs: number; decodeMs: number };
  /** Timed. */
  encode(): void;
  /** What must follow {@link encode} here but would not in a program. Not timed. */
  settle?(): void;
  /** Bytes of each packet of the last {@link encode}; 1200 at most, a blob cut up so. */
  packetBytes(): number[];
  /** Decodes the packets with these indices, in this order. Timed with all of them. */
  decode(packets: readonly number[]): void;
  /** What the last {@link decode} gave. */
  decoded(): DecodedCloud;
  /** Bits that packets which need no other take more than one packet of any length, as a share of that; where the codec tells. */
  independenceCost?(): number;
  /** Passes over the frame that the last {@link encode} took, where there is a budget. */
  passes?(): number;
}

/** Bytes of a packet's block. */
export const PACKET_BYTES = MAX_POINT_DATA_BYTES;

/** The sizes of a blob's packets. */
export function blobPackets(bytes: number): number[] {
  const full = Math.floor(bytes / PACKET_BYTES);
  return [
    ...new Array<number>(full).fill(PACKET_BYTES),
    ...(bytes % PACKET_BYTES > 0 ? [bytes % PACKET_BYTES] : []),
  ];
}

/** 6-6-4 bits (R highest) to R, G, B at the middle of each bin. */
export function write664(bits: number, rgb: Uint8Array, at: number): void {
  rgb[at] = ((bits >> 10) & 63) * 4 + 2;
  rgb[at + 1] = ((bits >> 4) & 63) * 4 + 2;
  rgb[at + 2] = (bits & 15) * 16 + 8;
}

/** 5-6-5 bits (R highest) to R, G, B. */
export function write565(bits: number, rgb: Uint8Array, at: number): void {
  rgb[at] = Math.round((((bits >> 11) & 31) * 255) / 31);
  rgb[at + 1] = Math.round((((bits >> 5) & 63) * 255) / 63);
  rgb[at + 2] = Math.round(((bits & 31) * 255) / 31);
}
