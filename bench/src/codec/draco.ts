/** Google Draco's point cloud codec, from npm's draco3d (WASM). */
import draco3d, {
  type DecoderModule,
  type DracoInt8Array,
  type Encoder,
  type EncoderModule,
  type PointCloud,
  type PointCloudBuilder,
} from 'draco3d';
import { type BenchCloud, blobPackets, type CodecRun } from './adapter.ts';

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
export function draco(
  { encoder, decoder }: Draco,
  cloud: BenchCloud,
  stepMm: number,
  speed: number,
): CodecRun {
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
  const sent = channels === 3 ? colours : colours.filter((_, i) => i % 3 === 0);
  const bits = Math.min(30, Math.max(1, Math.ceil(Math.log2((extent * 1000) / stepMm + 1))));
  let blob = new Int8Array(0);
  let out: DracoInt8Array | null = null;
  let length = 0;
  let metres = new Float32Array(0);
  let values = new Uint8Array(0);
  return {
    codec: 'draco',
    setting: `${bits} bits (≤ ${stepMm} mm), speed ${speed}`,
    blob: true,
    encode() {
      const builder = new encoder.PointCloudBuilder();
      const points = new encoder.PointCloud();
      const coder = new encoder.Encoder();
      if (out !== null) encoder.destroy(out);
      out = new encoder.DracoInt8Array();
      try {
        builder.AddFloatAttribute(points, encoder.POSITION as unknown as number, valid.length, 3, positions);
        builder.AddUInt8Attribute(points, encoder.COLOR as unknown as number, valid.length, channels, sent);
        coder.SetSpeedOptions(speed, speed);
        coder.SetAttributeQuantization(encoder.POSITION, bits);
        length = coder.EncodePointCloudToDracoBuffer(points, false, out);
        if (length <= 0) throw new Error('Draco did not encode');
      } finally {
        for (const object of [builder, points, coder]) encoder.destroy(object);
      }
    },
    // Byte by byte, because this build offers nothing else.
    settle() {
      const bytes = out;
      if (bytes !== null) blob = Int8Array.from({ length }, (_, i) => bytes.GetValue(i));
    },
    packetBytes: () => blobPackets(blob.length),
    decode() {
      const buffer = new decoder.DecoderBuffer();
      const coder = new decoder.Decoder();
      const points = new decoder.PointCloud();
      try {
        buffer.Init(blob, blob.length);
        const status = coder.DecodeBufferToPointCloud(buffer, points);
        if (!status.ok()) throw new Error(`Draco: ${status.error_msg()}`);
        const count = points.num_points();
        metres = readFloats(decoder, coder, points, count);
        values = readBytes(decoder, coder, points, count * channels);
      } finally {
        for (const object of [buffer, coder, points]) decoder.destroy(object);
      }
    },
    decoded() {
      const count = metres.length / 3;
      const rgb =
        channels === 3 ? values : new Uint8Array(count * 3).map((_, i) => values[Math.floor(i / 3)] ?? 0);
      return { points: count, metres, rgb, source: speed === 10 ? valid : null };
    },
    [Symbol.dispose]() {
      if (out !== null) encoder.destroy(out);
      out = null;
    },
  };
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
