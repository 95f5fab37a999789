import { describe, expect, it } from 'vitest';
import { isUserMessage } from './user-message-check.ts';

const open = Buffer.from([3, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0x61, 0x62, 0x63]);

describe('isUserMessage', () => {
  it('accepts messages of channels, and open messages whose lengths fit', () => {
    for (const protocol of [51, 53, 56, 57])
      expect(isUserMessage(protocol, Buffer.alloc(0), false)).toBe(true);
    expect(isUserMessage(50, open, false)).toBe(true);
    expect(isUserMessage(50, Buffer.from([2]), true)).toBe(true);
  });

  it.each([
    ['an unknown payload protocol', 52, Buffer.alloc(4)],
    ['an empty opening', 50, Buffer.alloc(0)],
    ['an unknown kind of opening', 50, Buffer.from([9])],
    ['an opening that is too short', 50, open.subarray(0, 11)],
    ['an opening whose label is cut', 50, open.subarray(0, 14)],
    ['an acknowledgement of no channel', 50, Buffer.from([2])],
  ])('refuses %s', (_, protocol, data) => {
    expect(isUserMessage(protocol, data, false)).toBe(false);
  });

  it('refuses another opening of an open channel', () => {
    expect(isUserMessage(50, open, true)).toBe(false);
  });
});
