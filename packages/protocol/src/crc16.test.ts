import { expect, it } from 'vitest';
import { CRC16_START, crc16OfWord } from './crc16.ts';

it('goes through words from the most significant bit on', () => {
  // Of "12345678", computed from the definition.
  expect(crc16OfWord(crc16OfWord(CRC16_START, 0x31323334), 0x35363738)).toBe(0xa12b);
  expect(crc16OfWord(CRC16_START, 0)).toBe(0x84c0);
});
