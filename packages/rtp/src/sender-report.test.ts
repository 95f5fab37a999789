import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RTCP_SENDER_REPORT, readReportBlocks } from './receiver-report.ts';
import { readSenderReport, type SenderReport, writeSenderReport } from './sender-report.ts';

const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));
const REPORT: SenderReport = {
  ...{ ssrc: 0xdeadbeef, ntp: { seconds: 0xeead9be0, fraction: 0x80000000 } },
  ...{ rtpTimestamp: 0x01020304, packets: 7, octets: 8400 },
};
const BYTES = '80c80006 deadbeef eead9be0 80000000 01020304 00000007 000020d0';
const BLOCK = '11223344 0a000005 0001abcd 0000005a 00000000 00000000';

function read(bytes: Uint8Array) {
  const reports: SenderReport[] = [];
  const fault = readSenderReport(bytes, (report) => reports.push(report));
  return { fault, reports };
}

describe('sender reports', () => {
  it('are written and read', () => {
    expect(writeSenderReport(REPORT)).toEqual(hex(BYTES));
    expect(read(hex(BYTES))).toEqual({ fault: null, reports: [REPORT] });
  });

  it('are read in front of report blocks', () => {
    const bytes = hex(`81c8000c ${BYTES.slice(9)} ${BLOCK}`);
    expect(read(bytes)).toEqual({ fault: null, reports: [REPORT] });
    expect(readReportBlocks(RTCP_SENDER_REPORT, bytes, () => {})).toBe(true);
  });

  it('wrap their counts', () => {
    const long = { ...REPORT, packets: 2 ** 32 + 7, octets: 2 ** 33 + 8400 };
    expect(writeSenderReport(long)).toEqual(hex(BYTES));
  });

  it.each([
    ['truncated', BYTES.slice(0, -8)],
    ['truncated', `81${BYTES.slice(2)}`],
    ['bad-length', `${BYTES} 00000000`],
    ['not-sender-report', `40${BYTES.slice(2)}`],
    ['not-sender-report', BYTES.replace('c8', 'c9')],
  ])('%s: %s', (fault, text) => {
    expect(read(hex(text))).toEqual({ fault, reports: [] });
  });

  it('round trip of any values, and any bytes without an exception', () => {
    const u32 = fc.nat(0xffff_ffff);
    const report = fc.record({
      ...{ ssrc: u32, rtpTimestamp: u32, packets: u32, octets: u32 },
      ntp: fc.record({ seconds: u32, fraction: u32 }),
    });
    fc.assert(
      fc.property(report, fc.uint8Array({ maxLength: 80 }), (any, noise) => {
        expect(read(writeSenderReport(any)).reports).toEqual([any]);
        const { fault, reports } = read(noise);
        expect(reports).toHaveLength(fault === null ? 1 : 0);
      }),
      { seed: 3, numRuns: 500 },
    );
  });
});
