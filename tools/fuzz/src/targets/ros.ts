import { encapsulationFault } from '@farpoint/dds/encapsulation';
import { decompressLz4 } from '@farpoint/recording/lz4';
import { cloudMessage } from '@farpoint/recording/testing';
import {
  type CompressedImage,
  colourOf,
  compressedPicture,
  decoderOf,
  depthOf,
  feedbackGoal,
  type Image,
  lazyDecoder,
  type PointCloud2,
  PointCloud2Decoder,
  readCancelReply,
  readGoalReply,
  readGoalSteps,
  readResultStep,
  readStdServiceReply,
  readUrdf,
} from '@farpoint/ros';
import type { FuzzTarget } from '../fuzz-target.ts';

const ROOM = new Float32Array(4 * 4096);
const WORDS = new Uint32Array(4096);

/** Each element and attribute that is read. */
const URDF = `<?xml version="1.0"?><robot name="r"><material name="m"><color rgba="1 0.5 0 1"/></material>
<link name="base_link"><visual><origin xyz="0 0 .1" rpy="0 -1e-1 2"/><geometry><box size="1 2 3"/></geometry></visual></link>
<link name="a"><visual><geometry><mesh filename="package://r/a.stl"/></geometry><material name="m"/></visual>
<collision><geometry><cylinder radius="0.1" length="2"/></geometry></collision></link><!-- none -->
<link name="b &amp; &#99;"><visual><geometry><sphere radius="1"/></geometry></visual></link>
<joint name="x" type="revolute"><parent link="base_link"/><child link="a"/><axis xyz="0 1 0"/></joint>
<joint name="y" type="fixed"><parent link="a"/><child link="b &amp; c"/><mimic joint="x" multiplier="2" offset="1"/></joint>
</robot>`;

/** CDR, little-endian: fields are aligned from the end of the four-byte header. */
class Cdr {
  readonly #bytes: number[] = [0, 1, 0, 0];

  align(size: number): this {
    while ((this.#bytes.length - 4) % size !== 0) this.#bytes.push(0);
    return this;
  }

  u8(value: number): this {
    this.#bytes.push(value);
    return this;
  }

  u32(value: number): this {
    this.align(4);
    this.#bytes.push(value & 255, (value >> 8) & 255, (value >> 16) & 255, value >>> 24);
    return this;
  }

  text(value: string): this {
    this.u32(value.length + 1);
    this.#bytes.push(...Buffer.from(value), 0);
    return this;
  }

  data(bytes: readonly number[]): this {
    this.u32(bytes.length);
    this.#bytes.push(...bytes);
    return this;
  }

  done(): Uint8Array {
    return Uint8Array.from(this.#bytes);
  }
}

const stamped = () => new Cdr().u32(1).u32(2).text('camera');
const image = (encoding: string, pixelBytes: number) =>
  stamped()
    .u32(4)
    .u32(4)
    .text(encoding)
    .u8(0)
    .u32(4 * pixelBytes)
    .data(new Array<number>(16 * pixelBytes).fill(9))
    .done();

function message(
  name: string,
  type: string,
  seeds: () => Uint8Array[],
  use: (value: never) => void = () => undefined,
): FuzzTarget {
  const decode = decoderOf(2, type, null);
  return { name, seeds, run: (input) => use(decode(input) as never), refusals: ['RosFault'] };
}

export const rosTargets: readonly FuzzTarget[] = [
  message(
    'ros-point-cloud',
    'sensor_msgs/msg/PointCloud2',
    () => [cloudMessage(1, 20)],
    (cloud: PointCloud2) => {
      new PointCloud2Decoder().decode(cloud, 'optical', ROOM);
    },
  ),
  message(
    'ros-image',
    'sensor_msgs/msg/Image',
    () =>
      ['rgb8', 'bgra8', 'mono8', '16UC1', '32FC1', 'bayer_rggb8', 'yuv422'].map((encoding) =>
        image(encoding, 4),
      ),
    (found: Image) => {
      if (found.encoding.startsWith('16') || found.encoding.startsWith('32')) depthOf(found, ROOM);
      else colourOf(found, WORDS);
    },
  ),
  message(
    'ros-compressed-image',
    'sensor_msgs/msg/CompressedImage',
    () => [
      stamped()
        .text('jpeg')
        .data([0xff, 0xd8, 0xff, 0xc0, 0, 11, 8, 0, 16, 0, 16, 1, 1, 0x11, 0, 0xff, 0xd9])
        .done(),
    ],
    (found: CompressedImage) => {
      compressedPicture(found);
    },
  ),
  message('ros-twist', 'geometry_msgs/msg/TwistStamped', () => [new Uint8Array(80)]),
  message('ros-odometry', 'nav_msgs/msg/Odometry', () => [new Uint8Array(740)]),
  message('ros-diagnostics', 'diagnostic_msgs/msg/DiagnosticArray', () => [
    stamped().u32(1).u8(1).text('motor').text('hot').text('id').u32(1).text('key').text('value').done(),
  ]),
  message('ros-transforms', 'tf2_msgs/msg/TFMessage', () => [
    new Cdr().u32(1).u32(1).u32(2).text('a').text('b').done(),
  ]),
  {
    name: 'ros1-point-cloud',
    seeds: () => [cloudMessage(1, 20).subarray(4), new Uint8Array(100)],
    run: (() => {
      const decode = decoderOf(1, 'sensor_msgs/PointCloud2', null);
      return (input: Uint8Array) => {
        new PointCloud2Decoder().decode(decode(input) as PointCloud2, 'body', ROOM);
      };
    })(),
    refusals: ['RosFault'],
  },
  {
    name: 'urdf',
    seeds: () => [Buffer.from(URDF)],
    run: (input) => void readUrdf(Buffer.from(input).toString()),
    refusals: ['UrdfFault'],
    maxBytes: 8192,
  },
  {
    name: 'protobuf-image',
    seeds: () => [Buffer.from('0a0408011002120663616d65726118042004280432047267623842', 'hex')],
    run: lazyDecoder({
      name: 'foxglove.RawImage',
      messageEncoding: 'protobuf',
      schemaEncoding: 'protobuf',
      schema: new Uint8Array(0),
    }) as (input: Uint8Array) => void,
    refusals: ['RosFault'],
  },
  {
    name: 'cdr-encapsulation',
    seeds: () => [Buffer.from([0, 1, 0, 0, 1, 2, 3, 4]), Buffer.from([0, 7, 0, 3])],
    run: (input) => void encapsulationFault('/topic', input),
    refusals: [],
  },
  {
    name: 'ros2-service-reply',
    seeds: () => [new Cdr().u8(1).text('charging').done(), new Cdr().u8(0).text('').done()],
    run: (input) => void readStdServiceReply('std_srvs/Trigger', input),
    refusals: ['RosFault'],
  },
  ...[readGoalReply, readCancelReply, readResultStep, feedbackGoal, readGoalSteps].map((read): FuzzTarget => {
    const id = new Array<number>(16).fill(7);
    return {
      name: `ros2-action-${read.name}`,
      // A list of one, and what has one byte first.
      seeds: () => [
        id
          .reduce((cdr, byte) => cdr.u8(byte), new Cdr().u32(1))
          .u32(5)
          .u32(6)
          .u8(2)
          .done(),
        new Cdr().u8(1).u32(5).u32(6).done(),
      ],
      run: (input) => void read(input),
      refusals: ['RosFault'],
    };
  }),
  {
    name: 'lz4',
    seeds: () => [Buffer.from('04224d186040820500008068656c6c6f00000000', 'hex')],
    run: (input) => void decompressLz4(input, 4096),
    refusals: ['Lz4Error', 'RecordingError', 'RangeError'],
  },
];
