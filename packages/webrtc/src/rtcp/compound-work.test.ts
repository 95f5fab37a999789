import { describe, expect, it } from 'vitest';
import { compoundWork, leadingReport, MAX_COMPOUND_BYTES, MAX_PARTS } from './compound-work.ts';

function part(type: number, format: number, words: number, fill = 0): Buffer {
  const bytes = Buffer.alloc(4 * (words + 1), fill);
  bytes.writeUInt8(0x80 | format, 0);
  bytes.writeUInt8(type, 1);
  bytes.writeUInt16BE(words, 2);
  return bytes;
}

describe('compoundWork', () => {
  it('counts the parts of what receivers send', () => {
    const report = part(201, 1, 7);
    expect(compoundWork(report)).toBe(1);
    expect(compoundWork(Buffer.concat([report, part(202, 1, 3), part(206, 1, 2)]))).toBe(3);
    // Nothing is for free.
    expect([0, 1, 3].map((length) => compoundWork(Buffer.alloc(length)))).toEqual([1, 1, 1]);
  });

  it('counts what feedback reports on, not what it weighs, wherever in the compound it is', () => {
    const feedback = part(205, 15, 9);
    feedback.writeUInt16BE(65_535, 14);
    expect(compoundWork(feedback)).toBe(256);
    expect(compoundWork(Buffer.concat([part(201, 0, 1), feedback]))).toBe(257);
    feedback.writeUInt16BE(200, 14);
    expect(compoundWork(feedback)).toBe(1);
  });

  it('counts long lists', () => {
    expect(compoundWork(part(205, 1, 319))).toBe(21);
  });

  it('refuses more parts, or bytes, than any receiver sends', () => {
    const parts = (count: number) => Buffer.concat(new Array<Buffer>(count).fill(part(203, 0, 0)));
    expect(compoundWork(parts(MAX_PARTS))).not.toBeNull();
    expect(compoundWork(parts(MAX_PARTS + 1))).toBeNull();
    expect(compoundWork(part(205, 1, MAX_COMPOUND_BYTES / 4 - 1))).not.toBeNull();
    expect(compoundWork(part(205, 1, MAX_COMPOUND_BYTES / 4))).toBeNull();
  });
});

describe('leadingReport', () => {
  it('is the first part if it is a report, and nothing else', () => {
    const report = part(200, 0, 6, 7);
    expect(leadingReport(Buffer.concat([report, part(205, 15, 9), part(205, 1, 9)]))).toEqual(report);
    expect(leadingReport(part(205, 15, 9))).toHaveLength(0);
    expect(leadingReport(Buffer.of(0x80))).toHaveLength(0);
    // One that is cut off is for werift to refuse.
    expect(leadingReport(report.subarray(0, 12))).toHaveLength(12);
  });
});
