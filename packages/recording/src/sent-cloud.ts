import {
  bytesOfPoints,
  type CloudFormat,
  emptyPointPacketHeader,
  PLACEMENT_BYTES,
  POINT_PACKET_HEADER_BYTES,
  readPointPlace,
  readPoints64Block,
  unpackBlue664,
  unpackGreen664,
  unpackRed664,
} from '@farpoint/protocol';
import { type Codec, OrganisedDecoder, UnorganisedDecoder } from '@farpoint/wasm-codec';
import { PointRoom } from './captured-cloud.ts';
import type { SentRecord } from './recorder-messages.ts';

/** Maximum number of points in a packet, for any format. */
const MOST_PACKET_POINTS = 4096;

/** Converts packets back into points, as an operator's page does. */
export class SentCloudDecoder {
  readonly #codec: Codec;
  readonly #header = emptyPointPacketHeader();
  readonly #room = new PointRoom();
  readonly #block = new Int16Array(MOST_PACKET_POINTS * 4);
  #organised: { header: Uint8Array; decoder: OrganisedDecoder } | null = null;
  #unorganised: UnorganisedDecoder | null = null;

  constructor(codec: Codec) {
    this.#codec = codec;
  }

  /**
   * @returns x, y, z in metres and a packed colour (0x00RRGGBB) for each point that could be decoded: four words each,
   * valid until the next call
   */
  decode(record: SentRecord): Uint32Array {
    const packets = [...payloads(record)];
    const decoders: Record<CloudFormat, () => Uint32Array> = {
      points64: () => this.#points64(packets, record.points),
      organised: () => this.#fromOrganised(packets, record.streamHeader),
      unorganised: () => this.#fromUnorganised(packets, record.points),
    };
    return decoders[record.format]();
  }

  #points64(packets: readonly Uint8Array[], points: number): Uint32Array {
    const words = this.#room.take(points);
    let count = 0;
    for (const packet of packets) {
      const view = new DataView(packet.buffer, packet.byteOffset, packet.byteLength);
      if (readPointPlace(view, this.#header) !== null) continue;
      const room = Math.min(
        this.#header.sequenceLength,
        bytesOfPoints(points - count),
        this.#block.byteLength,
      );
      const read = readPoints64Block(view, POINT_PACKET_HEADER_BYTES, room, this.#block, 0);
      fromMillimetres(this.#block, read, words, count);
      count += read;
    }
    return words.subarray(0, count * 4);
  }

  #fromOrganised(packets: readonly Uint8Array[], header: Uint8Array | null): Uint32Array {
    if (header === null) return new Uint32Array(0);
    if (this.#organised === null || !sameBytes(this.#organised.header, header)) {
      this.#organised?.decoder[Symbol.dispose]();
      this.#organised = { header, decoder: new OrganisedDecoder(this.#codec, header) };
    }
    const { decoder } = this.#organised;
    decoder.begin();
    for (const packet of packets) decoder.put(dataOf(packet));
    const bytes = decoder.unpack();
    const words = this.#room.take(decoder.count);
    fromMillimetres(
      new Int16Array(bytes.buffer, bytes.byteOffset, decoder.count * 4),
      decoder.count,
      words,
      0,
    );
    return words;
  }

  #fromUnorganised(packets: readonly Uint8Array[], points: number): Uint32Array {
    if (this.#unorganised === null || this.#unorganised.capacityPoints < points) {
      this.#unorganised?.[Symbol.dispose]();
      this.#unorganised = new UnorganisedDecoder(this.#codec, Math.ceil(points * 1.25) + 1, {
        colour: '664',
      });
    }
    const decoder = this.#unorganised;
    decoder.clear();
    for (const packet of packets) decoder.decode(dataOf(packet));
    const metres = decoder.metres();
    const raw = decoder.points;
    const count = metres.length / 3;
    const words = this.#room.take(count);
    const floats = new Float32Array(words.buffer, words.byteOffset, words.length);
    for (let i = 0; i < count; i++) {
      floats[i * 4] = metres[i * 3] as number;
      floats[i * 4 + 1] = metres[i * 3 + 1] as number;
      floats[i * 4 + 2] = metres[i * 3 + 2] as number;
      words[i * 4 + 3] = rgbOf664(raw[i * 4 + 3] as number);
    }
    return words;
  }
}

/** Extracts packets from their slots without a copy. */
function* payloads({ buffer, packets, slotBytes }: SentRecord): Generator<Uint8Array> {
  const view = new DataView(buffer);
  for (let i = 0; i < packets; i++) {
    const at = i * slotBytes;
    const length = view.getUint16(at + slotBytes - 2, true);
    if (length > POINT_PACKET_HEADER_BYTES + PLACEMENT_BYTES) yield new Uint8Array(buffer, at, length);
  }
}

function dataOf(packet: Uint8Array): Uint8Array {
  return packet.subarray(POINT_PACKET_HEADER_BYTES, packet.length - PLACEMENT_BYTES);
}

/** Converts from int16 x, y, z in millimetres and 6-6-4 colour. */
function fromMillimetres(points: Int16Array, count: number, words: Uint32Array, first: number): void {
  const floats = new Float32Array(words.buffer, words.byteOffset, words.length);
  for (let i = 0; i < count; i++) {
    const to = (first + i) * 4;
    floats[to] = (points[i * 4] as number) / 1000;
    floats[to + 1] = (points[i * 4 + 1] as number) / 1000;
    floats[to + 2] = (points[i * 4 + 2] as number) / 1000;
    words[to + 3] = rgbOf664(points[i * 4 + 3] as number);
  }
}

function rgbOf664(signed: number): number {
  const colour = signed & 0xffff;
  return (unpackRed664(colour) << 16) | (unpackGreen664(colour) << 8) | unpackBlue664(colour);
}

function sameBytes(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, i) => byte === b[i]);
}
