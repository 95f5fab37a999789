/** Decodes received `unorganised` packets to points in the renderer's layout. */
import { UnorganisedDecoder as WasmDecoder } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import { checkCapacity } from './slot-layout.ts';

/** Why a packet gave no points. */
export type UnorganisedFault =
  | 'too-short' // fewer bytes than a header and a checksum
  | 'too-long' // more than 1200 bytes
  | 'bad-check' // the checksum does not match the bytes
  | 'bad-version' // a different version of the format
  | 'bad-header' // a field of the header is out of range
  | 'bad-data' // the coded points end too early, too late or at an impossible value
  | 'full'; // no room for its points: call `clear` first

const FAULTS: readonly UnorganisedFault[] = [
  'too-short',
  'too-long',
  'bad-check',
  'bad-version',
  'bad-header',
  'bad-data',
  'full',
];

/** Maximum size of a packet, bytes. */
const MAX_PACKET_BYTES = 1200;

/** The points of one packet. */
export interface UnorganisedPlace {
  /** Metres; to be added to x, y, z × step. */
  origin: readonly [number, number, number];
  /** Metres. */
  step: number;
  /** Index of its first point. */
  first: number;
  count: number;
  attribute: 'none' | 'intensity' | 'colour';
}

const ATTRIBUTES = ['none', 'intensity', 'colour'] as const;

export interface UnorganisedDecoderOptions {
  /** Layout of the resulting colours: `565` (default) or `664`, as in `points64`. */
  colour?: '565' | '664';
  /** What each intensity 0…255 is mapped to (16 bits); default: itself. */
  palette?: Uint16Array;
}

/**
 * Decodes packets, in any order, into one block of memory: {@link decode} each, read {@link points}, {@link clear}.
 * Take the views from the decoder each time and do not keep them.
 */
export class UnorganisedDecoder implements Disposable {
  readonly capacityPoints: number;
  readonly #memory: Codec['memory'];
  readonly #decoder: WasmDecoder;

  /** @throws CodecError `bad-capacity`, or `bad-parameter` for a palette without exactly 256 entries */
  constructor(
    codec: Codec,
    capacityPoints: number,
    { colour = '565', palette }: UnorganisedDecoderOptions = {},
  ) {
    checkCapacity('capacityPoints', capacityPoints);
    if (palette !== undefined && palette.length !== 256) {
      throw new CodecError('bad-parameter', `a palette of ${palette.length} entries, not 256`);
    }
    this.capacityPoints = capacityPoints;
    this.#memory = codec.memory;
    this.#decoder = WasmDecoder.create(capacityPoints);
    this.#decoder.set_colour_664(colour === '664');
    if (palette !== undefined)
      new Uint16Array(codec.memory.buffer, this.#decoder.palette_ptr(), 256).set(palette);
  }

  /**
   * Appends a packet's points.
   *
   * @returns how many, or why there are none; a faulty packet leaves nothing behind
   */
  decode(packet: Uint8Array): number | UnorganisedFault {
    if (packet.length > MAX_PACKET_BYTES) return 'too-long';
    new Uint8Array(this.#memory.buffer, this.#decoder.packet_ptr(), MAX_PACKET_BYTES).set(packet);
    const points = this.#decoder.decode(packet.length);
    return points >= 0 ? points : (FAULTS[-1 - points] ?? 'bad-data');
  }

  /** Four int16 per point: x, y, z in steps from its packet's origin, and the bits of its colour or intensity. */
  get points(): Int16Array {
    const length = this.#decoder.points_length() * 4;
    return new Int16Array(this.#memory.buffer, this.#decoder.points_ptr(), length);
  }

  /** Packets decoded since {@link clear}. */
  get packetCount(): number {
    return this.#decoder.packets_length();
  }

  /** Four floats per packet, metres: its origin and its step. For the renderer, with {@link extents}. */
  get places(): Float32Array {
    return new Float32Array(this.#memory.buffer, this.#decoder.places_ptr(), this.packetCount * 4);
  }

  /** Three words per packet: its first point, how many, and 0 nothing, 1 intensity or 2 colour. */
  get extents(): Uint32Array {
    return new Uint32Array(this.#memory.buffer, this.#decoder.extents_ptr(), this.packetCount * 3);
  }

  /**
   * {@link places} and {@link extents} of one packet.
   *
   * @throws CodecError `bad-count` if there is no such packet
   */
  place(packet: number): UnorganisedPlace {
    if (!Number.isInteger(packet) || packet < 0 || packet >= this.packetCount) {
      throw new CodecError('bad-count', `packet ${packet} of ${this.packetCount}`);
    }
    const [x, y, z, step] = this.places.subarray(packet * 4) as unknown as [number, number, number, number];
    const [first, count, kind] = this.extents.subarray(packet * 3) as unknown as [number, number, 0 | 1 | 2];
    return { origin: [x, y, z], step, first, count, attribute: ATTRIBUTES[kind] };
  }

  /** All points in metres, three float32 each: for consumers that do not want {@link points}. */
  metres(): Float32Array {
    const at = this.#decoder.metres_ptr();
    return new Float32Array(this.#memory.buffer, at, this.#decoder.points_length() * 3);
  }

  /** Forgets all points. */
  clear(): void {
    this.#decoder.clear();
  }

  /** Frees the memory; the decoder and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#decoder.free();
  }
}
