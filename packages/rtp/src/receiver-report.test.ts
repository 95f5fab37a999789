import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  type ReportBlock,
  RTCP_RECEIVER_REPORT,
  RTCP_SENDER_REPORT,
  readReportBlocks,
} from './receiver-report.ts';

function blocksOf(packetType: number, bytes: Uint8Array): ReportBlock[] | null {
  const blocks: ReportBlock[] = [];
  return readReportBlocks(packetType, bytes, (block) => blocks.push({ ...block })) ? blocks : null;
}

/** One block: SSRC 0x11223344, 5 lost, highest 0x0001abcd, jitter 90. */
const BLOCK = '11223344 0a000005 0001abcd 0000005a 00000000 00000000'.replaceAll(' ', '');
const hex = (text: string) => new Uint8Array(Buffer.from(text.replaceAll(' ', ''), 'hex'));
const EXPECTED = { ssrc: 0x11223344, packetsLost: 5, highestSequence: 0x1abcd, jitter: 90 };

describe('readReportBlocks', () => {
  it('reads receiver and sender reports', () => {
    expect(blocksOf(RTCP_RECEIVER_REPORT, hex(`81c90007 00000001 ${BLOCK}`))).toEqual([EXPECTED]);
    const info = '00'.repeat(20);
    expect(blocksOf(RTCP_SENDER_REPORT, hex(`82c80013 00000001 ${info} ${BLOCK} ${BLOCK}`))).toHaveLength(2);
    expect(blocksOf(RTCP_RECEIVER_REPORT, hex('80c90001 00000001'))).toEqual([]);
  });

  it('reads a negative number of lost packets: duplicates', () => {
    const duplicates = BLOCK.replace('0a000005', '00fffffe');
    expect(blocksOf(RTCP_RECEIVER_REPORT, hex(`81c90007 00000001 ${duplicates}`))?.[0]?.packetsLost).toBe(-2);
  });

  it('reports nothing from a packet that is too short for its blocks, and never throws', () => {
    expect(blocksOf(RTCP_RECEIVER_REPORT, hex(`82c90007 00000001 ${BLOCK}`))).toBeNull();
    fc.assert(
      fc.property(fc.constantFrom(200, 201), fc.uint8Array({ maxLength: 80 }), (packetType, bytes) => {
        blocksOf(packetType, bytes);
      }),
      { seed: 9, numRuns: 1000 },
    );
  });
});
