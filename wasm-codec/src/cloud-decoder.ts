/** Decodes the data blocks of received packets to points in the renderer's layout. */
import { Decoder } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import {
  BYTES_PER_POINT,
  checkCapacity,
  checkSlotLayout,
  DEFAULT_SLOT_LAYOUT,
  POINTS_PER_PACKET,
  type SlotLayout,
} from './slot-layout.ts';

/**
 * Unpacks `points64` data blocks, many packets in one call. For each packet, {@link put} its block, then
 * {@link unpack}. As with the encoder, take the views from the decoder each time and do not keep them.
 */
export class CloudDecoder implements Disposable {
  readonly capacityPackets: number;
  readonly layout: Readonly<SlotLayout>;
  readonly #memory: Codec['memory'];
  readonly #decoder: Decoder;
  #buffer: ArrayBuffer | undefined;
  #slots = new Uint8Array(0);
  #counts = new Uint16Array(0);
  #points = new Int16Array(0);
  #pending = 0;

  /** @throws CodecError `bad-capacity`, `bad-layout` */
  constructor(codec: Codec, capacityPackets: number, layout: SlotLayout = DEFAULT_SLOT_LAYOUT) {
    checkCapacity('capacityPackets', capacityPackets);
    // 150 points per packet: the same bound on memory as an encoder's.
    checkCapacity('points', capacityPackets * POINTS_PER_PACKET);
    checkSlotLayout(layout);
    const decoder = Decoder.create(capacityPackets, layout.stride, layout.dataOffset);
    if (decoder === undefined) throw new CodecError('bad-layout', 'a block does not fit into its slot');
    this.capacityPackets = capacityPackets;
    this.layout = { ...layout };
    this.#memory = codec.memory;
    this.#decoder = decoder;
  }

  /** The packet slots: whole packets may be written here instead of {@link put}. */
  get slots(): Uint8Array {
    this.#refresh();
    return this.#slots;
  }

  /** The number of points of each slot, for packets that were written to {@link slots} directly. */
  get counts(): Uint16Array {
    this.#refresh();
    return this.#counts;
  }

  /** Packets that {@link put} has taken since the last {@link unpack}. */
  get pending(): number {
    return this.#pending;
  }

  /**
   * Copies one packet's data block (8 bytes per point) into the next slot.
   *
   * @throws CodecError `bad-count` if it is not 1 to 150 whole points, `too-many-packets` if no slot is free
   */
  put(block: Uint8Array): void {
    const count = block.length / BYTES_PER_POINT;
    if (!Number.isInteger(count) || count === 0 || count > POINTS_PER_PACKET) {
      throw new CodecError('bad-count', `a data block of ${block.length} bytes is not 1 to 150 points`);
    }
    if (this.#pending === this.capacityPackets) {
      throw new CodecError('too-many-packets', `all ${this.capacityPackets} slots are taken`);
    }
    this.#refresh();
    this.#slots.set(block, this.#pending * this.layout.stride + this.layout.dataOffset);
    this.#counts[this.#pending] = count;
    this.#pending++;
  }

  /**
   * Unpacks the first `packets` slots (by default those that {@link put} filled) and starts over.
   *
   * @returns x, y, z in millimetres and the colour's bits, four int16 per point: a view that is valid until the next
   * call
   * @throws CodecError `too-many-packets`, `bad-count`
   */
  unpack(packets: number = this.#pending): Int16Array {
    if (!Number.isInteger(packets) || packets < 0 || packets > this.capacityPackets) {
      throw new CodecError('too-many-packets', `${packets} packets in ${this.capacityPackets} slots`);
    }
    this.#pending = 0;
    const points = this.#decoder.unpack(packets);
    this.#refresh();
    if (points < 0) {
      const slot = -1 - points;
      throw new CodecError('bad-count', `packet ${slot} has ${this.#counts[slot]} points, more than 150`);
    }
    return this.#points.subarray(0, points * 4);
  }

  /** Frees the memory; the decoder and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#decoder.free();
  }

  #refresh(): void {
    const { buffer } = this.#memory;
    if (buffer === this.#buffer) return;
    this.#buffer = buffer;
    const decoder = this.#decoder;
    const packets = this.capacityPackets;
    this.#slots = new Uint8Array(buffer, decoder.slots_ptr(), packets * this.layout.stride);
    this.#counts = new Uint16Array(buffer, decoder.counts_ptr(), packets);
    this.#points = new Int16Array(buffer, decoder.points_ptr(), packets * POINTS_PER_PACKET * 4);
  }
}
