import { parseLogLine } from '@farpoint/media-process';
import { FROM_PROCESS as FROM_SOUND, parseSound, MessageParser as SoundParser } from '@farpoint/sound/wire';
import { parseEncoders, parseError, parseState } from '@farpoint/video/process-messages';
import { FROM_PROCESS as FROM_VIDEO, parseEncoded, MessageParser as VideoParser } from '@farpoint/video/wire';
import type { FuzzTarget } from '../fuzz-target.ts';

function framed(type: number, payload: Uint8Array): Uint8Array {
  const header = Buffer.alloc(5);
  header.writeUInt32LE(payload.length, 0);
  header.writeUInt8(type, 4);
  const swapped = Buffer.alloc(5);
  swapped.writeUInt8(type, 0);
  swapped.writeUInt32LE(payload.length, 1);
  // Whichever of the two the parser reads, the other is a mutation of it.
  return Buffer.concat([swapped, payload, header, payload]);
}

const state = Buffer.from('{"state":"playing","width":640,"height":480,"framesPerSecond":30}');

/** What programs of ours say that run GStreamer, whose plugins are not ours. */
export const processTargets: readonly FuzzTarget[] = [
  {
    name: 'video-process',
    seeds: () => [
      framed(FROM_VIDEO.encoded, new Uint8Array(60)),
      framed(FROM_VIDEO.state, state),
      framed(FROM_VIDEO.error, state),
    ],
    run: (input) => {
      const parser = new VideoParser();
      parser.push(input.subarray(0, 3), () => undefined);
      parser.push(input.subarray(3), ({ type, payload }) => {
        if (type === FROM_VIDEO.encoded) parseEncoded(payload);
        else if (type === FROM_VIDEO.state) parseState(payload);
        else parseError(payload);
      });
    },
    refusals: ['WireError'],
  },
  {
    name: 'video-encoded',
    seeds: () => [new Uint8Array(60)],
    run: (input) => void parseEncoded(input),
    refusals: ['WireError'],
  },
  {
    name: 'video-encoders',
    seeds: () => [Buffer.from('{"encoders":[{"name":"x264enc","codec":"h264","hardware":false}]}')],
    run: (input) => void parseEncoders(input),
    refusals: ['WireError'],
  },
  {
    name: 'sound-process',
    seeds: () => [framed(FROM_SOUND.sound, new Uint8Array(40)), framed(FROM_SOUND.state, state)],
    run: (input) => {
      new SoundParser().push(input, ({ type, payload }) => {
        if (type === FROM_SOUND.sound) parseSound(payload);
      });
    },
    refusals: ['WireError'],
  },
  {
    name: 'process-log',
    seeds: () => [Buffer.from('{"level":"warn","msg":"x"}'), Buffer.from('free text')],
    run: (input) => void parseLogLine(Buffer.from(input).toString()),
    refusals: [],
  },
];
