import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { dtlsRecord } from '../testing/dtls-record.ts';
import { MAX_RECORDS, parseRecords } from './record.ts';

const records = fc.array(
  fc.record({
    contentType: fc.integer({ min: 20, max: 23 }),
    epoch: fc.nat(0xffff),
    sequence: fc.nat(2 ** 48 - 1),
    fragment: fc.uint8Array({ minLength: 1, maxLength: 50 }),
  }),
  { maxLength: 4 },
);

describe('parseRecords', () => {
  it('reads back what was written, up to the first damage', () => {
    fc.assert(
      fc.property(records, fc.nat(12), (written, cut) => {
        const bytes = Buffer.concat(
          written.map(({ contentType, epoch, sequence, fragment }) =>
            dtlsRecord(contentType, epoch, sequence, fragment),
          ),
        );
        const whole = parseRecords(bytes);
        expect(whole.malformed).toBe(false);
        const read = whole.records.map(({ version: _, ...rest }) => rest);
        expect(read).toEqual(written.map((one) => ({ ...one, fragment: Buffer.from(one.fragment) })));
        if (written.length === 0 || cut === 0) return;
        const damaged = parseRecords(bytes.subarray(0, bytes.length - Math.min(cut, 1)));
        expect(damaged.malformed).toBe(true);
        expect(damaged.records).toHaveLength(written.length - 1);
      }),
      { seed: 2 },
    );
  });

  it('reads no more records than a datagram of a peer has', () => {
    const many = Buffer.concat(
      new Array<Buffer>(MAX_RECORDS + 1).fill(dtlsRecord(23, 1, 1, Uint8Array.of(1))),
    );
    expect(parseRecords(many.subarray(14))).toMatchObject({ malformed: false });
    expect(parseRecords(many).malformed).toBe(true);
    expect(parseRecords(many).records).toHaveLength(MAX_RECORDS);
  });

  it.each([
    ['an unknown content type', dtlsRecord(24, 0, 0, new Uint8Array(1))],
    ['an empty fragment', dtlsRecord(22, 0, 0, new Uint8Array(0))],
    ['another version', Buffer.from(dtlsRecord(22, 0, 0, new Uint8Array(1)).fill(3, 1, 3))],
  ])('refuses %s', (_, bytes) => {
    expect(parseRecords(bytes)).toEqual({ records: [], malformed: true });
  });
});
