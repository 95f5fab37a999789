import { VIDEO_CODECS, type VideoCodec } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import type { VideoRefusal } from '../transport/answered-codecs.ts';
import { codecFault } from './codec-fault.ts';

const line = (refusal: VideoRefusal | null, codecs: readonly VideoCodec[] = []) => ({
  ...{ mid: '1', transport: null, refusal },
  payloadTypes: new Map(codecs.map((codec) => [codec, 96])),
});

it.each([
  [line(null, VIDEO_CODECS), null],
  [line(null, ['H264']), null],
  [line(null, ['VP8']), /does not decode H264, which the camera has at present for others/],
  [line('refused'), /does not decode H264: give the camera another encoder/],
  [line('no-common-codec'), /does not decode H264: give the camera another encoder/],
  [line('bad-payload-type'), /answer cannot be used: .*\(bad-payload-type\)$/],
  [line('other-parameters'), /another profile or packetization mode only \(other-parameters\)$/],
])('says what is wrong with an operator’s line: %#', (each, words) => {
  const fault = codecFault(each, 'H264');
  if (words === null) expect(fault).toBeNull();
  else {
    expect(fault).toMatch(words);
    // What a message takes.
    expect(fault?.length).toBeLessThanOrEqual(256);
  }
});
