import { expect, it } from 'vitest';
import { ReplayedRtcp } from './replayed-rtcp.ts';

function sealed(ssrc: number, index: number): Buffer {
  const packet = Buffer.alloc(40, 5);
  packet.writeUInt32BE(ssrc, 4);
  packet.writeUInt32BE((0x80000000 | index) >>> 0, 36);
  return packet;
}

it('knows what was received, of each sender by itself', () => {
  const replayed = new ReplayedRtcp();
  expect(replayed.has(sealed(1, 1))).toBe(false);
  replayed.mark(sealed(1, 1));
  expect(replayed.has(sealed(1, 1))).toBe(true);
  expect(replayed.has(sealed(1, 2))).toBe(false);
  expect(replayed.has(sealed(2, 1))).toBe(false);
  // One that was overtaken is no repetition.
  replayed.mark(sealed(1, 9));
  expect(replayed.has(sealed(1, 5))).toBe(false);
  expect(replayed.has(sealed(1, 1))).toBe(true);
});

it('remembers a bounded number of senders', () => {
  const replayed = new ReplayedRtcp();
  for (let ssrc = 0; ssrc < 65; ssrc++) replayed.mark(sealed(ssrc, 1));
  expect(replayed.has(sealed(1, 1))).toBe(true);
  expect(replayed.has(sealed(0, 1))).toBe(false);
});

it('leaves what is no packet to the deciphering', () => {
  const replayed = new ReplayedRtcp();
  for (let length = 0; length < 28; length++) {
    replayed.mark(Buffer.alloc(length));
    expect(replayed.has(Buffer.alloc(length))).toBe(false);
  }
});
