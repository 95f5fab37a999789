/** CRC-16/CCITT-FALSE: polynomial 0x1021, initial value 0xffff, nothing reflected. */

const POLYNOMIAL = 0x1021;

/** What the checksum of the first byte continues from. */
export const CRC16_START = 0xffff;

/** The checksum after 32 more bits, most significant first. */
export function crc16OfWord(crc: number, word: number): number {
  let value = crc;
  for (let bit = 31; bit >= 0; bit--) {
    const isSet = ((value >> 15) & 1) !== ((word >>> bit) & 1);
    value = ((value << 1) & 0xffff) ^ (isSet ? POLYNOMIAL : 0);
  }
  return value;
}
