import { describe, expect, it } from 'vitest';
import { isSctpPacket } from './packet-check.ts';

const header = Buffer.alloc(12);

function chunk(type: number, body: number[], length = body.length + 4): Buffer {
  const padding = (4 - (body.length % 4)) % 4;
  return Buffer.from([type, 0, length >> 8, length & 0xff, ...body, ...new Array(padding).fill(0)]);
}

function packet(...chunks: Buffer[]): Buffer {
  return Buffer.concat([header, ...chunks]);
}

const zeros = (count: number): number[] => new Array(count).fill(0);

describe('isSctpPacket', () => {
  it('accepts chunks of every kind that werift reads', () => {
    const sack = chunk(3, [...zeros(8), 0, 2, 0, 1, 0, 2, 0, 3, 0, 5, 0, 5, 1, 2, 3, 4]);
    const init = chunk(1, [...zeros(16), 0x80, 8, 0, 6, 130, 192, 0, 0]);
    const ones = [chunk(0, zeros(13)), sack, chunk(4, [0, 1, 0, 8, 9, 9, 9, 9]), chunk(192, zeros(8))];
    expect(isSctpPacket(packet(init))).toBe(true);
    for (const one of ones) expect(isSctpPacket(packet(one))).toBe(true);
    expect(isSctpPacket(packet(...ones))).toBe(true);
  });

  it.each([
    ['three bytes', Buffer.from([1, 2, 3])],
    ['no chunk', header],
    ['a chunk of length 0, which would never end', packet(chunk(0, zeros(13), 0))],
    ['a chunk beyond the packet', packet(chunk(0, zeros(13), 400))],
    ['a chunk that is too short for its kind', packet(chunk(1, zeros(8)))],
    ['an unknown chunk', packet(chunk(77, zeros(4)))],
    ['a parameter of length 0, which would never end', packet(chunk(130, [0, 13, 0, 0, 1, 1, 1, 1]))],
    ['a parameter beyond the chunk', packet(chunk(130, [0, 13, 0, 90, 1, 1, 1, 1]))],
    ['missing gap blocks', packet(chunk(3, [...zeros(8), 0, 9, 0, 0]))],
    ['gaps that overlap', packet(chunk(3, [...zeros(8), 0, 2, 0, 0, 0, 1, 0, 9, 0, 5, 0, 12]))],
    ['no data', packet(chunk(0, zeros(12)))],
    ['a heartbeat of two parameters, which would be echoed', packet(chunk(4, [0, 1, 0, 4, 0, 1, 0, 4]))],
    ['a heartbeat of none', packet(chunk(4, []))],
    ['three requests in one RE-CONFIG', packet(chunk(130, [0, 13, 0, 4, 0, 13, 0, 4, 0, 13, 0, 4]))],
    ['more causes of an error than there are', packet(chunk(9, new Array(33).fill([0, 1, 0, 4]).flat()))],
    ['a packet that no path takes', packet(chunk(0, zeros(2040)))],
    ['a gap that runs backwards', packet(chunk(3, [...zeros(8), 0, 1, 0, 0, 0, 9, 0, 1]))],
  ])('refuses %s', (_, bytes) => {
    expect(isSctpPacket(bytes)).toBe(false);
  });
});
