import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readPictureLoss, writePictureLoss } from './picture-loss.ts';

const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));
const PLI = '81ce0002 00000001 deadbeef';
const FIR = '84ce0006 00000001 00000000 11223344 05000000 fffffffe ff000000';

function read(bytes: Uint8Array) {
  const requests: [number, number | null][] = [];
  const fault = readPictureLoss(bytes, (...request) => requests.push(request));
  return { fault, requests };
}

describe('readPictureLoss', () => {
  it('reads a PLI: the stream is in its header', () => {
    expect(read(hex(PLI))).toEqual({ fault: null, requests: [[0xdeadbeef, null]] });
    expect(writePictureLoss(1, 0xdeadbeef)).toEqual(hex(PLI));
  });

  it('reads a FIR: streams and command numbers are in its body', () => {
    expect(read(hex(FIR))).toEqual({
      fault: null,
      requests: [
        [0x11223344, 5],
        [0xfffffffe, 255],
      ],
    });
  });

  it.each([
    ['truncated', PLI.slice(0, -2)],
    ['not-picture-loss', PLI.replace('ce', 'cd')],
    ['not-picture-loss', PLI.replace('81', '8f')],
    ['not-picture-loss', PLI.replace('81', '41')],
    ['bad-length', PLI.replace('81', 'a1')],
    ['bad-length', PLI.replace('ce0002', 'ce0003')],
    ['bad-length', `${PLI.replace('ce0002', 'ce0003')} 00000000`],
    ['bad-length', PLI.replace('81', '84')],
    ['bad-length', FIR.replace('ce0006', 'ce0005').slice(0, -9)],
  ])('%s: %s', (fault, text) => {
    expect(read(hex(text))).toEqual({ fault, requests: [] });
  });

  it('any bytes give requests or a fault', () => {
    const head = fc.constantFrom(0x81, 0x84).map((first) => [first, 206, 0]);
    const packet = fc
      .tuple(head, fc.nat(8), fc.uint8Array({ maxLength: 36, size: 'max' }))
      .map(([first, words, rest]) => Uint8Array.from([...first, words, ...rest]));
    fc.assert(
      fc.property(fc.oneof(packet, fc.uint8Array({ maxLength: 40 })), (bytes) => {
        const { fault, requests } = read(bytes);
        expect(requests.length > 0).toBe(fault === null);
      }),
      { seed: 5, numRuns: 1000 },
    );
  });
});
