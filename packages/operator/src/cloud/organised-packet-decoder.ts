import {
  copyPlacement,
  emptyPlacement,
  emptyPointPacketHeader,
  type Placement,
  type PointPacketHeader,
  pointsOfBytes,
  sequenceDelta32,
} from '@farpoint/protocol';
import { type Codec, OrganisedDecoder, type PutResult } from '@farpoint/wasm-codec';
import type { PointLook, TileGrid } from './batch.ts';
import { DecodedPoints } from './decoded-points.ts';
import { DecodedTiles } from './decoded-tiles.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';

/** Neighbours on the grid are one mean distance apart: circles as wide as a cell's diagonal close the gaps. */
const COVER = Math.SQRT2;
/** Where the stream header has the image's size and the camera (docs/organised-codec.md). */
const [WIDTH_AT, HEIGHT_AT, FX_AT, FY_AT, CX_AT, CY_AT] = [8, 10, 12, 16, 20, 24];

/** One frame being decoded. */
interface FrameDecoder {
  decoder: OrganisedDecoder;
  frameNumber: number | null;
}

/** The first of two packets, held until the second comes. */
class HeldPacket {
  readonly header: PointPacketHeader = emptyPointPacketHeader();
  readonly placement: Placement = emptyPlacement();
  receivedAtMs = 0;
  data: Uint8Array = new Uint8Array(0);
  /** The decoder of the held packet's frame; `null` if no packet is held. */
  decoder: OrganisedDecoder | null = null;

  hold(
    decoder: OrganisedDecoder,
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedAtMs: number,
  ): void {
    this.decoder = decoder;
    Object.assign(this.header, header);
    copyPlacement(placement, this.placement);
    this.receivedAtMs = receivedAtMs;
    this.data = data;
  }
}

/**
 * Decodes `organised`. Two packets of a frame are decoded together, which is faster; a single one left at the end of a
 * frame or burst is decoded by itself. Two frames are open at a time, because packets at a frame's end may overtake
 * each other.
 */
export class OrganisedPacketDecoder implements PacketDecoder, Disposable {
  readonly #open: [FrameDecoder, FrameDecoder];
  readonly #points = new DecodedPoints();
  readonly #tiles = new DecodedTiles();
  readonly #look: PointLook;
  readonly #grid: TileGrid;
  readonly #held = new HeldPacket();
  #newest = 0;

  /** @throws {CodecError} `bad-stream-header` */
  constructor(codec: Codec, header: Uint8Array) {
    const make = () => ({ decoder: new OrganisedDecoder(codec, header), frameNumber: null });
    this.#open = [make(), make()];
    const view = new DataView(header.buffer, header.byteOffset, header.byteLength);
    const float = (at: number) => view.getFloat32(at, true);
    this.#grid = {
      width: view.getUint16(WIDTH_AT, true),
      height: view.getUint16(HEIGHT_AT, true),
      fx: float(FX_AT),
      fy: float(FY_AT),
      cx: float(CX_AT),
      cy: float(CY_AT),
    };
    const { width, height, fx, fy } = this.#grid;
    const area = (width / fx) * (height / fy);
    this.#look = { imageExtent: Math.sqrt(area), unit: 0.001, cover: COVER };
  }

  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedAtMs: number,
    writer: BatchWriter,
  ): void {
    const held = this.#held;
    // A new frame may replace the held packet's frame.
    if (held.header.frameNumber !== header.frameNumber) this.settle(writer);
    const decoder = this.#frame(header.frameNumber, writer.surface);
    if (decoder === null) {
      writer.drop('late');
      return;
    }
    if (held.decoder === null) {
      held.hold(decoder, header, placement, data, receivedAtMs);
      return;
    }
    const before = decoder.count;
    const [first, second] = decoder.putTwo(held.data, data);
    held.decoder = null;
    const between = before + pointsOf(first);
    this.#write(decoder, before, first, held.header, held.placement, held.receivedAtMs, writer);
    this.#write(decoder, between, second, header, placement, receivedAtMs, writer);
  }

  settle(writer: BatchWriter): void {
    const { decoder, header, placement, data, receivedAtMs } = this.#held;
    if (decoder === null) return;
    this.#held.decoder = null;
    const before = decoder.count;
    this.#write(decoder, before, decoder.put(data), header, placement, receivedAtMs, writer);
  }

  finish(): void {}

  abandon(): void {
    this.#held.decoder = null;
  }

  [Symbol.dispose](): void {
    this.abandon();
    for (const { decoder } of this.#open) decoder[Symbol.dispose]();
  }

  /** Hands on a packet's points, which begin at the decoder's point `start`. */
  #write(
    decoder: OrganisedDecoder,
    start: number,
    result: PutResult,
    header: PointPacketHeader,
    placement: Placement,
    receivedAtMs: number,
    writer: BatchWriter,
  ): void {
    if ('fault' in result) {
      writer.drop(result.fault);
      return;
    }
    if (result.points !== pointsOfBytes(header.sequenceLength)) {
      writer.drop('bad-count');
      return;
    }
    if (decoder.isSurface) {
      this.#tiles.write(
        decoder.samples,
        result.firstTile,
        result.tiles,
        header,
        placement,
        receivedAtMs,
        this.#look,
        this.#grid,
        writer,
      );
      return;
    }
    const bytes = decoder.unpack();
    const at = bytes.byteOffset + start * 4 * Int16Array.BYTES_PER_ELEMENT;
    const points = new Int16Array(bytes.buffer, at, result.points * 4);
    this.#look.cover = COVER * Math.sqrt(writer.every);
    this.#points.write(points, header, placement, receivedAtMs, this.#look, writer);
  }

  /** The decoder of a frame; a new frame replaces the older of the two. `null` for a frame before them. */
  #frame(frameNumber: number, surface: boolean): OrganisedDecoder | null {
    const newest = this.#open[this.#newest] as FrameDecoder;
    if (newest.frameNumber === frameNumber) return newest.decoder;
    const other = this.#open[1 - this.#newest] as FrameDecoder;
    if (other.frameNumber === frameNumber) return other.decoder;
    if (newest.frameNumber !== null && sequenceDelta32(frameNumber, newest.frameNumber) < 0) return null;
    other.frameNumber = frameNumber;
    other.decoder.surface = surface;
    other.decoder.begin();
    this.#newest = 1 - this.#newest;
    return other.decoder;
  }
}

function pointsOf(result: PutResult): number {
  return 'points' in result ? result.points : 0;
}
