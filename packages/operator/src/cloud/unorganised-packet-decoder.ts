import {
  decodeUnorganisedStream,
  type Placement,
  type PointPacketHeader,
  pointsOfBytes,
} from '@farpoint/protocol';
import { type Codec, UnorganisedDecoder } from '@farpoint/wasm-codec';
import { type PointLook, SAMPLED_COVER } from './batch.ts';
import { DecodedPoints } from './decoded-points.ts';
import { ImageExtent } from './image-extent.ts';
import type { BatchWriter, PacketDecoder } from './packet-decoder.ts';

/** A packet with more points than this is invalid, since packets have at most 1200 bytes. */
const MOST_POINTS = 65_536;

/** Decodes `unorganised`: each packet by itself, converted from its own origin and step to the stream's unit. */
export class UnorganisedPacketDecoder implements PacketDecoder, Disposable {
  readonly #decoder: UnorganisedDecoder;
  readonly #unit: number;
  readonly #extent = new ImageExtent();
  readonly #points = new DecodedPoints();
  readonly #look: PointLook;
  #turned = new Int16Array(4 * 1024);

  /** @throws {ProtocolError} if the stream header is invalid */
  constructor(codec: Codec, header: Uint8Array) {
    this.#unit = decodeUnorganisedStream(header).unitMm / 1000;
    this.#decoder = new UnorganisedDecoder(codec, MOST_POINTS, { colour: '664' });
    this.#look = { imageExtent: 0, unit: this.#unit, cover: SAMPLED_COVER };
  }

  add(
    header: PointPacketHeader,
    placement: Placement,
    data: Uint8Array,
    receivedAtMs: number,
    writer: BatchWriter,
  ): void {
    const decoder = this.#decoder;
    decoder.clear();
    const count = decoder.decode(data);
    if (typeof count === 'string') {
      writer.drop(count);
      return;
    }
    if (count !== pointsOfBytes(header.sequenceLength)) {
      writer.drop('bad-count');
      return;
    }
    if (this.#turned.length < count * 4) this.#turned = new Int16Array(count * 8);
    const points = this.#turned.subarray(0, count * 4);
    this.#turn(decoder.points, decoder.places, points);
    this.#extent.addVertices(header.frameNumber, points, 0, count);
    this.#look.imageExtent = this.#extent.value;
    this.#look.cover = SAMPLED_COVER * Math.sqrt(writer.every);
    this.#points.write(points, header, placement, receivedAtMs, this.#look, writer);
  }

  settle(): void {}

  finish(): void {}

  abandon(): void {}

  [Symbol.dispose](): void {
    this.#decoder[Symbol.dispose]();
  }

  #turn(from: Int16Array, place: Float32Array, into: Int16Array): void {
    const perUnit = 1 / this.#unit;
    const step = (place[3] as number) * perUnit;
    const [x, y, z] = [0, 1, 2].map((axis) => (place[axis] as number) * perUnit) as [number, number, number];
    for (let i = 0; i < into.length; i += 4) {
      into[i] = toInt16(x + (from[i] as number) * step);
      into[i + 1] = toInt16(y + (from[i + 1] as number) * step);
      into[i + 2] = toInt16(z + (from[i + 2] as number) * step);
      into[i + 3] = from[i + 3] as number;
    }
  }
}

/** Rounds, and saturates values that do not fit, which would otherwise wrap around. */
function toInt16(value: number): number {
  return Math.min(Math.max(Math.round(value), -32_767), 32_767);
}
