/** Google Draco's point cloud codec, from npm's draco3d (WASM). */
import draco3d, {
  type DecoderModule,
  type DracoInt8Array,
  type Encoder,
  type EncoderModule,
  type PointCloud,
  type PointCloudBuilder,
} from 'draco3d';
import { type BenchCloud, blobPackets, type CodecRun, type DecodedCloud } from './adapter.ts';

/** Members of the module that its published types lack. */
interface PointEncoderModule extends Omit<EncoderModule, 'Encoder'> {
  PointCloudBuilder: new () => PointCloudBuilder;
  PointCloud: new () => PointCloud;
  Encoder: new () => Encoder & {
    EncodePointCloudToDracoBuffer(points: PointCloud, deduplicate: boolean, out: DracoInt8Array): number;
  };
}

export interface Draco {
  encoder: PointEncoderModule;
  decoder: DecoderModule;
}

export async function loadDraco(): Promise<Draco> {
  const encoder = (await draco3d.createEncoderModule({})) as unknown as PointEncoderModule;
  return { encoder, decoder: await draco3d.createDecoderModule({}) };
}

/** @param speed 10 is the fastest and keeps the order; below 10, points are sorted into a k-d tree */
export function draco(modules: Draco, cloud: BenchCloud, stepMm: number, speed: number): CodecRun {
  return new DracoRun(modules, cloud, stepMm, speed);
}

/** The cloud's measured points, as Draco takes them. */
interface DracoInput {
  positions: Float32Array;
  /** Bytes of each point: three of a colour, or one of an intensity. */
  values: Uint8Array;
  channels: number;
  /** Size along the longest axis, m. */
  extent: number;
}

function inputOf(cloud: BenchCloud): DracoInput {
  const { valid, frame } = cloud;
  const positions = new Float32Array(valid.length * 3);
  const colours = new Uint8Array(valid.length * 3);
  const bytes = new Uint8Array(frame.buffer, frame.byteOffset, frame.byteLength);
  let extent = 0;
  for (let axis = 0; axis < 3; axis++) {
    let [least, most] = [Infinity, -Infinity];
    valid.forEach((index, i) => {
      const value = frame[index * 4 + axis] as number;
      positions[i * 3 + axis] = value;
      least = Math.min(least, value);
      most = Math.max(most, value);
      const channel = cloud.attribute === 'colour' ? axis : 0;
      colours[i * 3 + axis] = bytes[index * 16 + 12 + channel] as number;
    });
    extent = Math.max(extent, most - least);
  }
  const channels = cloud.attribute === 'colour' ? 3 : 1;
  const values = channels === 3 ? colours : colours.filter((_, i) => i % 3 === 0);
  return { positions, values, channels, extent };
}

class DracoRun implements CodecRun {
  readonly codec = 'draco';
  readonly setting: string;
  readonly blob = true;
  readonly #modules: Draco;
  readonly #valid: Uint32Array;
  readonly #input: DracoInput;
  readonly #bits: number;
  readonly #speed: number;
  #out: DracoInt8Array | null = null;
  #length = 0;
  #blob = new Int8Array(0);
  #metres = new Float32Array(0);
  #values = new Uint8Array(0);

  constructor(modules: Draco, cloud: BenchCloud, stepMm: number, speed: number) {
    this.#modules = modules;
    this.#valid = cloud.valid;
    this.#input = inputOf(cloud);
    const steps = (this.#input.extent * 1000) / stepMm + 1;
    this.#bits = Math.min(30, Math.max(1, Math.ceil(Math.log2(steps))));
    this.#speed = speed;
    this.setting = `${this.#bits} bits (≤ ${stepMm} mm), speed ${speed}`;
  }

  encode(): void {
    const { encoder } = this.#modules;
    const { positions, values, channels } = this.#input;
    const { length: count } = this.#valid;
    const builder = new encoder.PointCloudBuilder();
    const points = new encoder.PointCloud();
    const coder = new encoder.Encoder();
    if (this.#out !== null) encoder.destroy(this.#out);
    this.#out = new encoder.DracoInt8Array();
    try {
      builder.AddFloatAttribute(points, encoder.POSITION as unknown as number, count, 3, positions);
      builder.AddUInt8Attribute(points, encoder.COLOR as unknown as number, count, channels, values);
      coder.SetSpeedOptions(this.#speed, this.#speed);
      coder.SetAttributeQuantization(encoder.POSITION, this.#bits);
      this.#length = coder.EncodePointCloudToDracoBuffer(points, false, this.#out);
      if (this.#length <= 0) throw new Error('Draco did not encode');
    } finally {
      for (const object of [builder, points, coder]) encoder.destroy(object);
    }
  }

  /** Copies byte by byte, because this build offers nothing else. */
  settle(): void {
    const bytes = this.#out;
    if (bytes !== null) this.#blob = Int8Array.from({ length: this.#length }, (_, i) => bytes.GetValue(i));
  }

  packetBytes(): number[] {
    return blobPackets(this.#blob.length);
  }

  decode(): void {
    const { decoder } = this.#modules;
    const buffer = new decoder.DecoderBuffer();
    const coder = new decoder.Decoder();
    const points = new decoder.PointCloud();
    try {
      buffer.Init(this.#blob, this.#blob.length);
      const status = coder.DecodeBufferToPointCloud(buffer, points);
      if (!status.ok()) throw new Error(`Draco: ${status.error_msg()}`);
      const count = points.num_points();
      this.#metres = readFloats(decoder, coder, points, count);
      this.#values = readBytes(decoder, coder, points, count * this.#input.channels);
    } finally {
      for (const object of [buffer, coder, points]) decoder.destroy(object);
    }
  }

  decoded(): DecodedCloud {
    const count = this.#metres.length / 3;
    const values = this.#values;
    const rgb =
      this.#input.channels === 3
        ? values
        : new Uint8Array(count * 3).map((_, i) => values[Math.floor(i / 3)] ?? 0);
    return { points: count, metres: this.#metres, rgb, source: this.#speed === 10 ? this.#valid : null };
  }

  [Symbol.dispose](): void {
    if (this.#out !== null) this.#modules.encoder.destroy(this.#out);
    this.#out = null;
  }
}

type PointDecoder = InstanceType<DecoderModule['Decoder']>;

function readFloats(
  module: DecoderModule,
  coder: PointDecoder,
  points: PointCloud,
  count: number,
): Float32Array<ArrayBuffer> {
  const bytes = count * 12;
  const pointer = module._malloc(bytes);
  const attribute = coder.GetAttribute(
    points,
    coder.GetAttributeId(points, module.POSITION as unknown as number),
  );
  coder.GetAttributeDataArrayForAllPoints(points, attribute, module.DT_FLOAT32, bytes, pointer);
  const values = new Float32Array(module.HEAPF32.buffer, pointer, count * 3).slice();
  module._free(pointer);
  return values as Float32Array<ArrayBuffer>;
}

function readBytes(
  module: DecoderModule,
  coder: PointDecoder,
  points: PointCloud,
  bytes: number,
): Uint8Array<ArrayBuffer> {
  const pointer = module._malloc(bytes);
  const attribute = coder.GetAttribute(
    points,
    coder.GetAttributeId(points, module.COLOR as unknown as number),
  );
  coder.GetAttributeDataArrayForAllPoints(points, attribute, module.DT_UINT8, bytes, pointer);
  const values = new Uint8Array(module.HEAPU8.buffer, pointer, bytes).slice();
  module._free(pointer);
  return values as Uint8Array<ArrayBuffer>;
}
