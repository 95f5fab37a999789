import { expect, it } from 'vitest';
import { asBroadcast } from './broadcast-description.ts';

it('describes videos with the codecs of their m-lines, and says why one with another has no pictures', () => {
  const fault = 'the camera is unplugged';
  expect(
    asBroadcast(
      [
        { name: 'Front', codec: 'VP8' },
        { name: 'Rear', codec: 'VP8' },
        { name: 'Arm', codec: 'VP8', fault },
      ],
      ['H264', 'VP8', 'H264'],
    ),
  ).toEqual([
    {
      name: 'Front',
      codec: 'H264',
      fault: 'the robot encodes it as VP8 at present, for an operator who does not decode H264',
    },
    { name: 'Rear', codec: 'VP8' },
    { name: 'Arm', codec: 'H264', fault },
  ]);
});
