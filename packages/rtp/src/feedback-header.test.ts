import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { mediaSsrcOf } from './feedback-header.ts';
import { writeNack } from './nack-writer.ts';
import { writePictureLoss } from './picture-loss.ts';
import { walkRtcp } from './rtcp.ts';
import { writeSenderReport } from './sender-report.ts';
import { writeTransportFeedback } from './transport-feedback-writer.ts';

describe('mediaSsrcOf', () => {
  it('tells the streams of a compound packet apart', () => {
    const feedback = {
      senderSsrc: 1,
      mediaSsrc: 0xfffffffd,
      baseSequence: 0,
      feedbackCount: 0,
      arrivalsUs: [0],
    };
    const ntp = { seconds: 0, fraction: 0 };
    const compound = Buffer.concat([
      writeSenderReport({ ssrc: 9, ntp, rtpTimestamp: 0, packets: 0, octets: 0 }),
      writeNack(1, 0xdeadbeef, [5]),
      writePictureLoss(1, 77),
      writeTransportFeedback(feedback),
    ]);
    const ssrcs = [...walkRtcp(new Uint8Array(compound))].map(({ bytes }) => mediaSsrcOf(bytes));
    expect(ssrcs).toEqual([null, 0xdeadbeef, 77, 0xfffffffd]);
  });

  it('finds none in other packets, nor in any bytes that are too short', () => {
    const nack = writeNack(1, 2, [5]);
    expect(mediaSsrcOf(nack.subarray(0, 11))).toBeNull();
    expect(mediaSsrcOf(Uint8Array.from(nack, (byte, i) => (i === 1 ? 204 : byte)))).toBeNull();
    expect(mediaSsrcOf(Uint8Array.from(nack, (byte, i) => (i === 0 ? byte & 0x7f : byte)))).toBeNull();
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 11 }), (bytes) => {
        expect(mediaSsrcOf(bytes)).toBeNull();
      }),
      { seed: 4, numRuns: 200 },
    );
  });
});
