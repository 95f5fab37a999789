import { describe, expect, it } from 'vitest';
import { ReportSums } from './report-sums.ts';

const block = (highestSequence: number, packetsLost = 0, ssrc = 7) => ({
  ssrc,
  packetsLost,
  highestSequence,
  jitter: 0,
});

describe('ReportSums', () => {
  it('counts from the first packet, across wraps, and knows when the highest was sent', () => {
    const sums = new ReportSums(7);
    // One packet per millisecond, from shortly before a wrap.
    for (let n = 0; n < 2000; n++) sums.onSent((65_000 + n) & 0xffff, n);
    expect(sums.read(block(65_099, 4), 140)).toEqual({
      packetsReceived: 96,
      packetsLost: 4,
      source: 'rtcp',
      rttMs: 41,
    });
    expect(sums.read(block(65_536 + 463, 4), 1050)).toMatchObject({ packetsReceived: 996, rttMs: 51 });
  });

  it('gives no round trip if nothing has arrived since, or the packet is forgotten', () => {
    const sums = new ReportSums(7);
    for (let n = 0; n < 10_000; n++) sums.onSent(n, n);
    expect(sums.read(block(9999), 10_040)?.rttMs).toBe(41);
    expect(sums.read(block(9999), 11_000)?.rttMs).toBeNull();
    const slow = new ReportSums(7);
    for (let n = 0; n < 10_000; n++) slow.onSent(n, n);
    expect(slow.read(block(5), 10_000)?.rttMs).toBeNull();
  });

  it('accepts duplicates, and refuses impossible blocks', () => {
    const sums = new ReportSums(7);
    expect(sums.read(block(5), 0)).toBeNull();
    sums.onSent(100, 0);
    expect(sums.read(block(100, -1), 1)?.packetsReceived).toBe(2);
    expect(sums.read(block(100, 0, 8), 1)).toBeNull();
    expect(sums.read(block(99), 1)).toBeNull();
    expect(sums.read(block(100, 2), 1)).toBeNull();
  });
});
