import {
  decodePcd,
  parseIntrinsics,
  parsePcdHeader,
  parseTrajectoryLog,
  pcdIntensity,
} from '@farpoint/cloud-formats';
import {
  decodeUnorganisedStream,
  emptyPictureChunkHeader,
  emptyPlacement,
  emptyPointPacketHeader,
  encodeUnorganisedStream,
  PictureAssembler,
  readCaptureStamp,
  readCloudPayload,
  readPictureChunk,
  readPictureFile,
  readPointPacketHeader,
} from '@farpoint/protocol';
import {
  HEADER_BYTES,
  makeHeader,
  parseFrameHeader,
  parseHeader,
  writeFrameHeader,
  writeHeader,
} from '@farpoint/shared-memory/layouts';
import type { FuzzTarget } from '../fuzz-target.ts';
import { vectors } from '../vectors.ts';

const dataView = ({ buffer, byteOffset, byteLength }: Uint8Array) =>
  new DataView(buffer, byteOffset, byteLength);

function pcd(data: string, body: Uint8Array = new Uint8Array(0)): Uint8Array {
  const header =
    '# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n' +
    `WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ${data}\n`;
  return Buffer.concat([Buffer.from(header), body]);
}

export const cloudTargets: readonly FuzzTarget[] = [
  {
    name: 'cloud-payload',
    seeds: () => vectors('protocol', 'cloud-payload'),
    run: (input) => {
      readCloudPayload(dataView(input), emptyPointPacketHeader(), emptyPlacement());
      readPointPacketHeader(dataView(input), emptyPointPacketHeader());
    },
    refusals: [],
  },
  {
    name: 'picture-chunk',
    seeds: () => vectors('protocol', 'picture-chunk'),
    run: (input) => {
      readPictureChunk(dataView(input), emptyPictureChunkHeader());
      const assembler = new PictureAssembler();
      assembler.cameras = 2;
      assembler.take(input);
      assembler.take(input);
    },
    refusals: [],
  },
  {
    name: 'picture-file',
    seeds: () => [
      Buffer.from('ffd8ffe000104a46494600010100000100010000ffc0000b080010001001011100ffd9', 'hex'),
      Buffer.from('89504e470d0a1a0a0000000d49484452000000100000001008060000001ff3ff61', 'hex'),
    ],
    run: (input) => void readPictureFile(input),
    refusals: [],
  },
  {
    name: 'capture-stamp',
    seeds: () => vectors('protocol', 'capture-stamp'),
    run: (input) => {
      readCaptureStamp(input, 'H264');
      readCaptureStamp(input, 'VP8');
    },
    refusals: [],
  },
  {
    name: 'unorganised-stream',
    seeds: () => [encodeUnorganisedStream({ unitMm: 4 })],
    run: (input) => void decodeUnorganisedStream(input),
    refusals: ['ProtocolError'],
  },
  {
    name: 'pcd',
    seeds: () => [
      pcd('binary', new Uint8Array(32)),
      pcd('ascii', Buffer.from('1 2 3 4\n5 6 7 nan\n')),
      pcd('binary_compressed', Buffer.from([4, 0, 0, 0, 32, 0, 0, 0, 31, 1, 2, 3])),
    ],
    run: (input) => {
      parsePcdHeader(input);
      decodePcd(input);
      pcdIntensity(input);
    },
    refusals: ['PcdError', 'LzfError'],
  },
  {
    name: 'rgbd-intrinsics',
    seeds: () => [
      Buffer.from('{"width":640,"height":480,"intrinsic_matrix":[525,0,0,0,525,0,319.5,239.5,1]}'),
    ],
    run: (input) => void parseIntrinsics(Buffer.from(input).toString()),
    refusals: ['RgbdError'],
  },
  {
    name: 'trajectory-log',
    seeds: () => [Buffer.from('0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n')],
    run: (input) => void parseTrajectoryLog(Buffer.from(input).toString()),
    refusals: ['TrajectoryError'],
  },
  {
    name: 'shared-memory',
    maxBytes: HEADER_BYTES + 128,
    seeds: () => {
      const header = makeHeader({ format: 'points', maxPoints: 100, framesPerSecond: 30 } as never);
      const bytes = new Uint8Array(HEADER_BYTES + 128);
      writeHeader(bytes, header);
      const frame = {
        capturedAtMs: 5,
        width: 10,
        height: 10,
        pose: null,
        lens: null,
        latencyTest: false,
        depthUnit: 0.001,
      };
      writeFrameHeader(bytes.subarray(HEADER_BYTES), 1, frame as never);
      return [bytes];
    },
    run: (input) => {
      const slot = input.subarray(input.length - 128);
      const first = input.subarray(0, HEADER_BYTES);
      const word = (at: number) => (first.length >= at + 4 ? dataView(first).getUint32(at, true) : 0);
      // The size that the header itself claims, so that the header's other checks are reached.
      const header = parseHeader(first, HEADER_BYTES + word(20) * word(24), 'file');
      if (slot.length === 128) parseFrameHeader(slot, header, 'file', HEADER_BYTES);
    },
    refusals: ['SharedMemoryError'],
  },
];
