import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { annexBNalUnits, h264ProfileLevelId, isH264KeyFrame } from './h264-nal.ts';
import { annexB, anyUnits, PPS, SPS, slice } from './testing/pictures.ts';

const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));
const unitsOf = (text: string) =>
  [...annexBNalUnits(hex(text))].map((unit) => Buffer.from(unit).toString('hex'));

describe('annexBNalUnits', () => {
  it('divides at start codes of three and of four bytes', () => {
    expect(unitsOf('00000001 6742c01f 000001 68ce3c80 00000001 6588')).toEqual([
      '6742c01f',
      '68ce3c80',
      '6588',
    ]);
  });

  it('leaves out zeros before the first start code and behind a NAL unit, and empty NAL units', () => {
    expect(unitsOf('000000000001 0910 0000 000001 41 000001 000001 42 000000')).toEqual(['0910', '41', '42']);
  });

  it('takes zeros and ones inside a NAL unit for no start code', () => {
    expect(unitsOf('000001 65000301000002010001 000001 41')).toEqual(['65000301000002010001', '41']);
  });

  it.each([
    ['nothing', ''],
    ['a start code alone', '00000001'],
    ['no start code', '65888421'],
    ['lengths instead of start codes', '00000004 65888421'],
    ['something before the first start code', '05 000001 65888421'],
  ])('finds none in %s', (_name, text) => {
    expect(unitsOf(text)).toEqual([]);
  });

  it('finds what was joined, whatever the start codes', () => {
    fc.assert(
      fc.property(anyUnits(40), fc.array(fc.constantFrom(3, 4), { minLength: 1 }), (units, codes) => {
        expect([...annexBNalUnits(annexB(units, codes))]).toEqual(units);
      }),
      { seed: 1, numRuns: 500 },
    );
  });

  it('finds NAL units without a start code, in any bytes', () => {
    const bytes = fc.array(fc.constantFrom(0, 0, 1, 3, 0x65), { maxLength: 40, size: 'max' });
    fc.assert(
      fc.property(bytes, (some) => {
        for (const unit of annexBNalUnits(Uint8Array.from([0, 0, 1, ...some]))) {
          expect(unit.at(-1)).not.toBe(0);
          expect(Buffer.from(unit).includes(Buffer.of(0, 0, 1))).toBe(false);
        }
      }),
      { seed: 2, numRuns: 2000 },
    );
  });
});

it('an access unit is a key frame if it has an IDR slice', () => {
  expect(isH264KeyFrame(annexB([SPS, PPS, slice(true, 9)]))).toBe(true);
  expect(isH264KeyFrame(annexB([slice(false, 9), slice(false, 9)]))).toBe(false);
  expect(isH264KeyFrame(annexB([SPS, PPS]))).toBe(false);
  expect(isH264KeyFrame(slice(true, 9))).toBe(false);
});

it('profile-level-id: the three bytes behind the header of the sequence parameter set', () => {
  expect(h264ProfileLevelId(annexB([Uint8Array.of(9, 0x10), SPS, PPS]))).toBe('42c01f');
  expect(h264ProfileLevelId(hex('000001 6764000a ac'))).toBe('64000a');
  expect(h264ProfileLevelId(annexB([PPS, slice(true, 9)]))).toBeNull();
  expect(h264ProfileLevelId(hex('000001 674201'))).toBeNull();
});
