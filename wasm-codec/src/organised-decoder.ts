import { OrganisedDecoder as Binding } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';

/** Why a packet is refused; nothing of it is kept. */
export type PacketFault =
  | 'too-short'
  | 'too-long'
  | 'bad-check' // the checksum does not match the bytes
  | 'reserved' // a reserved bit is set
  | 'unknown-stream' // its stream header has not arrived, or is another's
  | 'bad-tiles' // tiles that the image does not have
  | 'duplicate' // tiles that have already arrived in this frame
  | 'corrupt'; // coded as no encoder would

/** `firstTile` and `tiles` say which of the image's tiles the packet had, numbered row by row. */
export type PutResult = { points: number; firstTile: number; tiles: number } | { fault: PacketFault };

/** Pixels along a tile's side, and samples of a tile. */
export const TILE = 16;
export const TILE_SAMPLES = TILE * TILE;

const FAULTS: readonly PacketFault[] = [
  'too-short',
  'too-long',
  'bad-check',
  'reserved',
  'unknown-stream',
  'bad-tiles',
  'duplicate',
  'corrupt',
];
const HEADER_FAULTS = ['its length', 'its first bytes', 'its version', 'its check value', 'a value'];
const PACKET_ROOM = 1201;

/** Decodes one stream's packets, in any order and each alone. */
export class OrganisedDecoder implements Disposable {
  readonly width: number;
  readonly height: number;
  readonly #memory: Codec['memory'];
  readonly #binding: Binding;
  readonly #images: boolean;
  #buffer: ArrayBuffer | undefined;
  #packets: readonly [Uint8Array, Uint8Array] = [new Uint8Array(0), new Uint8Array(0)];
  #tiles = new Uint32Array(0);

  /**
   * @param options.images also produce depth and colour images
   * @throws CodecError `bad-stream-header`
   */
  constructor(codec: Codec, streamHeader: Uint8Array, options: { images?: boolean } = {}) {
    this.#images = options.images ?? false;
    const fault = Binding.fault_of(streamHeader);
    const binding = fault === 0 ? Binding.create(streamHeader, this.#images) : undefined;
    if (binding === undefined) {
      throw new CodecError('bad-stream-header', `stream header: ${HEADER_FAULTS[fault - 1] ?? 'a value'}`);
    }
    this.#memory = codec.memory;
    this.#binding = binding;
    this.width = binding.width();
    this.height = binding.height();
  }

  /**
   * Whether frames that begin from now on are surfaces instead of points: {@link samples} then has their tiles, and
   * {@link unpack} and the images have nothing.
   */
  set surface(wanted: boolean) {
    this.#binding.want_surface(wanted);
  }

  /** Whether the frame is a surface. */
  get isSurface(): boolean {
    return this.#binding.sample_count() > 0;
  }

  /**
   * A view of the surface's samples, {@link TILE_SAMPLES} for each tile of the image: in the lower 16 bits the inverse
   * depth as a half float, 1/m, 0 where nothing was seen; in the upper the colour, 5-6-5 bits, R highest. Only those of
   * tiles that have arrived in the frame mean anything.
   */
  get samples(): Uint32Array {
    return new Uint32Array(this.#memory.buffer, this.#binding.samples_ptr(), this.#binding.sample_count());
  }

  /** Begins a frame: no points, empty images. */
  begin(): void {
    this.#binding.begin();
  }

  /** Decodes a packet and adds its points to {@link unpack}. */
  put(packet: Uint8Array): PutResult {
    if (packet.length >= PACKET_ROOM) return { fault: 'too-long' };
    this.#rooms[0].set(packet);
    return this.#resultOf(this.#binding.put(packet.length), 0);
  }

  /** Like {@link put} of one and then the other, but faster: the best way to put the packets of a frame. */
  putTwo(first: Uint8Array, second: Uint8Array): [PutResult, PutResult] {
    if (first.length >= PACKET_ROOM || second.length >= PACKET_ROOM) {
      return [this.put(first), this.put(second)];
    }
    const [room, secondRoom] = this.#rooms;
    room.set(first);
    secondRoom.set(second);
    const points = this.#binding.put_two(first.length, second.length);
    return [this.#resultOf(points, 0), this.#resultOf(this.#binding.second(), 1)];
  }

  /** Where packets are written; recreated when the module's memory has grown. */
  get #rooms(): readonly [Uint8Array, Uint8Array] {
    const { buffer } = this.#memory;
    if (buffer !== this.#buffer) {
      const start = this.#binding.packets_ptr();
      this.#buffer = buffer;
      this.#packets = [
        new Uint8Array(buffer, start, PACKET_ROOM),
        new Uint8Array(buffer, start + PACKET_ROOM, PACKET_ROOM),
      ];
      this.#tiles = new Uint32Array(buffer, this.#binding.tiles_ptr(), 4);
    }
    return this.#packets;
  }

  #resultOf(points: number, packet: 0 | 1): PutResult {
    if (points < 0) return { fault: FAULTS[-1 - points] ?? 'corrupt' };
    // Current after any call: the views are renewed with the memory.
    void this.#rooms;
    return {
      points,
      firstTile: this.#tiles[2 * packet] as number,
      tiles: this.#tiles[2 * packet + 1] as number,
    };
  }

  /** Points of the frame so far. */
  get count(): number {
    return this.#binding.count();
  }

  /** Whether a packet of the frame belonged to a latency test: all its points are pure green. */
  get latencyTest(): boolean {
    return this.#binding.latency_test();
  }

  /**
   * A view of the frame's points so far, in the order of their packets: int16 x, y, z in millimetres and 6-6-4 colour,
   * the vertex layout of `points64`.
   */
  unpack(): Uint8Array {
    return new Uint8Array(this.#memory.buffer, this.#binding.points_ptr(), this.count * 8);
  }

  /** Depth along z in metres, 0 where nothing has arrived; empty without `images`. */
  get depth(): Float32Array {
    const length = this.#images ? this.width * this.height : 0;
    return new Float32Array(this.#memory.buffer, this.#binding.depth_ptr(), length);
  }

  /** R, G, B, 255 of each pixel, R lowest, 0 where nothing has arrived; empty without `images`. */
  get colour(): Uint32Array {
    const length = this.#images ? this.width * this.height : 0;
    return new Uint32Array(this.#memory.buffer, this.#binding.colour_ptr(), length);
  }

  /** Frees the memory; the decoder and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#binding.free();
  }
}
