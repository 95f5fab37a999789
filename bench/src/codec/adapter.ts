/** What the codec benchmark needs of a codec. */
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';

/** A frame with its points in file or raster order. */
export interface BenchCloud {
  name: string;
  /** If there is no grid, the height is 1. */
  width: number;
  height: number;
  /** Of the depth camera; null if the file does not contain them. */
  intrinsics: { fx: number; fy: number; cx: number; cy: number } | null;
  /** x, y, z in metres and the attribute's bits, four words per point. NaN marks missing measurements. */
  frame: Float32Array;
  /** Contents of the fourth word: bytes R, G, B, 255 from the lowest, or an intensity 0…255. */
  attribute: 'colour' | 'intensity';
  /** `z`: optical axes. `range`: a sensor at the origin that looks in all directions. */
  depth: 'z' | 'range';
  /** Indices of the points that are finite and not at depth 0, ascending. */
  valid: Uint32Array;
}

/** A decoder's output. */
export interface DecodedCloud {
  points: number;
  /** Metres, three numbers per point. */
  metres: Float64Array | Float32Array;
  /** R, G, B per point, or the intensity three times. */
  rgb: Uint8Array;
  /** Each point's index in the frame; null if the codec reorders points, which are then matched to the nearest. */
  source: Uint32Array | null;
}

/** A codec at one setting, prepared for one cloud. */
export interface CodecRun extends Disposable {
  codec: string;
  setting: string;
  /** True if one lost packet loses the frame. */
  blob: boolean;
  /** Default true; false if the setting sends no colour. */
  hasColour?: boolean;
  /** Times of the same code outside WASM. */
  native?(rounds: number): { encodeMs: number; decodeMs: number };
  /** Timed. */
  encode(): void;
  /** Work that must follow {@link encode} here, but not in a real program. Not timed. */
  settle?(): void;
  /** Size of each packet of the last {@link encode}, bytes: at most 1200, into which a blob is cut. */
  packetBytes(): number[];
  /** Decodes the packets with these indices, in this order. Timed with all packets. */
  decode(packets: readonly number[]): void;
  /** The result of the last {@link decode}. */
  decoded(): DecodedCloud;
  /**
   * Extra bits of independent packets compared with a single packet of any length, as a share; if the codec reports
   * it.
   */
  independenceCost?(): number;
  /** Passes over the frame in the last {@link encode}, if there is a budget. */
  passes?(): number;
}

/** Size of a packet's block, bytes. */
export const PACKET_BYTES = MAX_POINT_DATA_BYTES;

/** The sizes of a blob's packets. */
export function blobPackets(bytes: number): number[] {
  const full = Math.floor(bytes / PACKET_BYTES);
  return [
    ...new Array<number>(full).fill(PACKET_BYTES),
    ...(bytes % PACKET_BYTES > 0 ? [bytes % PACKET_BYTES] : []),
  ];
}

/** 6-6-4 bits (R highest) to R, G, B at the centre of each bin. */
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
