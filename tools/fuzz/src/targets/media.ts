import {
  annexBNalUnits,
  emptyRtpHeader,
  h264ProfileLevelId,
  isH264KeyFrame,
  mediaSsrcOf,
  packetiseH264,
  packetiseVp8,
  parseTransportFeedback,
  readAbsCaptureTime,
  readNack,
  readPictureLoss,
  readRemb,
  readReportBlocks,
  readRtpHeader,
  readSenderReport,
  VideoDepacketiser,
  vp8KeyFrameSize,
  walkRtcp,
  writePictureLoss,
  writeSenderReport,
} from '@farpoint/rtp';
import { opusDurationMs } from '@farpoint/sound';
import { noiseRtcp, noiseRtp } from '@farpoint/webrtc/testing';
import type { FuzzTarget } from '../fuzz-target.ts';
import { vectors } from '../vectors.ts';

const nothing = () => undefined;
const accessUnit = Buffer.concat(
  [
    [0x67, 0x42, 0xe0, 0x1f, 1, 2],
    [0x68, 1, 2, 3],
    [0x65, ...new Array<number>(300).fill(9)],
  ].map((nal) => Buffer.from([0, 0, 0, 1, ...nal])),
);
const vp8 = Buffer.from([0x10, 2, 0, 0x9d, 1, 0x2a, 0x80, 2, 0xe0, 1, ...new Array<number>(300).fill(9)]);

/** One payload, and the same cut in two, with numbers that follow each other and numbers that do not. */
function depacketise(codec: 'h264' | 'vp8'): (input: Uint8Array) => void {
  return (input) => {
    const reader = new VideoDepacketiser(codec, {
      maxFrameBytes: 65_536,
      waitForKeyFrame: (input[0] ?? 0) % 2 === 0,
    });
    const half = input.length >> 1;
    reader.take(1, 9, false, input.subarray(0, half));
    reader.take(2, 9, true, input.subarray(half));
    reader.take(3, 10, false, input);
    reader.take(5, 11, true, input);
    reader.take(65_535, 12, true, input);
  };
}

export const mediaTargets: readonly FuzzTarget[] = [
  {
    name: 'rtp-header',
    seeds: () => [
      noiseRtp(96, 1, 1, 60),
      Buffer.from('90e0000100000001000000010bede0001310001ff'.padEnd(80, '0'), 'hex'),
    ],
    run: (input) => {
      readRtpHeader(input, 3, emptyRtpHeader());
      readAbsCaptureTime(input);
    },
    refusals: [],
  },
  {
    name: 'rtcp',
    seeds: () => [
      noiseRtcp(205, 1, 40),
      writePictureLoss(1, 2),
      writeSenderReport({
        ssrc: 1,
        ntp: { seconds: 1, fraction: 2 },
        rtpTimestamp: 2,
        packets: 3,
        octets: 4,
      }),
      ...vectors('rtp', 'transport-feedback'),
    ],
    run: (input) => {
      for (const { packetType, bytes } of walkRtcp(input, nothing)) {
        readRemb(bytes);
        readNack(bytes, nothing);
        readPictureLoss(bytes, nothing);
        readSenderReport(bytes, nothing);
        mediaSsrcOf(bytes);
        if (packetType === 200 || packetType === 201) readReportBlocks(packetType, bytes, nothing);
      }
    },
    refusals: [],
  },
  {
    name: 'transport-feedback',
    seeds: () => vectors('rtp', 'transport-feedback'),
    run: (input) => void parseTransportFeedback(input),
    refusals: ['TransportFeedbackError'],
  },
  {
    name: 'h264-payload',
    seeds: () => [...packetiseH264(accessUnit, 100), ...packetiseH264(accessUnit, 1000)],
    run: depacketise('h264'),
    refusals: [],
  },
  {
    name: 'h264-access-unit',
    seeds: () => [accessUnit],
    run: (input) => {
      for (const _ of annexBNalUnits(input)) nothing();
      isH264KeyFrame(input);
      h264ProfileLevelId(input);
    },
    refusals: [],
  },
  {
    name: 'vp8-payload',
    seeds: () => [...packetiseVp8(vp8, 5, 100), ...packetiseVp8(vp8, 5, 1000)],
    run: depacketise('vp8'),
    refusals: [],
  },
  {
    name: 'vp8-frame',
    seeds: () => [vp8],
    run: (input) => void vp8KeyFrameSize(input),
    refusals: [],
  },
  {
    name: 'opus-packet',
    seeds: () => [Buffer.from([0x78, 1, 2, 3]), Buffer.from([0x7b, 0x83, 1, 2]), Buffer.from([0xfc])],
    run: (input) => void opusDurationMs(input),
    refusals: [],
  },
];
