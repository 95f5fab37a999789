import type { Placement, PointPacketHeader } from '@farpoint/protocol';
import { type Codec, OrganisedDecoder } from '@farpoint/wasm-codec';
import type { PointLook } from './batch.ts';
import { DecodedPoints } from './decoded-points.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';
import type { DropReason } from './packet-intake.ts';

/** Neighbours on the grid are one mean distance apart: circles of its diagonal close the gaps. */
const COVER = Math.SQRT2;
/** Where the stream header has the image's size and focal lengths (docs/organised-codec.md). */
const [WIDTH_AT, HEIGHT_AT, FX_AT, FY_AT] = [8, 10, 12, 16];

/** One frame being decoded. */
interface FrameDecoder {
  decoder: OrganisedDecoder;
  frameNumber: number | null;
}

/** `organised`: each packet at once. Two frames are open at a time: packets at a frame's end may overtake each other. */
export class OrganisedPacketDecoder implements PacketDecoder, Disposable {
  readonly #open: [FrameDecoder, FrameDecoder];
  readonly #points = new DecodedPoints();
  readonly #look: PointLook;
  #newest = 0;

  /** @throws {CodecError} `bad-stream-header` */
  constructor(codec: Codec, header: Uint8Array) {
    const make = () => ({ decoder: new OrganisedDecoder(codec, header), frameNumber: null });
    this.#open = [make(), make()];
    const view = new DataView(header.buffer, header.byteOffset, header.byteLength);
    const [width, height] = [view.getUint16(WIDTH_AT, true), view.getUint16(HEIGHT_AT, true)];
    const area = (width / view.getFloat32(FX_AT, true)) * (height / view.getFloat32(FY_AT, true));
    this.#look = { imageExtent: Math.sqrt(area), unit: 0.001, cover: COVER };
  }

  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedMs: number,
    writer: BatchWriter,
  ): DropReason | null {
    const open = this.#frame(header.frameNumber);
    if (open === null) return 'late';
    const { decoder } = open;
    const before = decoder.count;
    const result = decoder.put(data);
    if ('fault' in result) return result.fault;
    if (result.points !== header.sequenceLength / 8) return 'bad-count';
    const bytes = decoder.unpack();
    const points = new Int16Array(bytes.buffer, bytes.byteOffset + before * 8, result.points * 4);
    this.#look.cover = COVER * Math.sqrt(writer.every);
    return this.#points.write(points, header, placement, receivedMs, this.#look, writer);
  }

  finish(): void {}

  abandon(): void {}

  [Symbol.dispose](): void {
    for (const { decoder } of this.#open) decoder[Symbol.dispose]();
  }

  /** The decoder of a frame; a new frame takes the place of the older of the two. `null` for one before them. */
  #frame(frameNumber: number): FrameDecoder | null {
    const newest = this.#open[this.#newest] as FrameDecoder;
    if (newest.frameNumber === frameNumber) return newest;
    const other = this.#open[1 - this.#newest] as FrameDecoder;
    if (other.frameNumber === frameNumber) return other;
    if (newest.frameNumber !== null && ((frameNumber - newest.frameNumber) | 0) < 0) return null;
    other.frameNumber = frameNumber;
    other.decoder.begin();
    this.#newest = 1 - this.#newest;
    return other;
  }
}
