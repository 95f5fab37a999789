import { sendRtcp } from '@farpoint/webrtc';
import { RtpHeader } from 'werift';
import { bytes4, feedback, filled, losses, MANY, rtcp, times } from '../repeat/bytes.ts';
import { type Pattern, repeated } from '../repeat/repeated.ts';

/** The same compound packet again and again, under the guest's keys. */
const same =
  (...parts: readonly Buffer[]): Pattern =>
  ({ dtls }) => {
    const compound = Buffer.concat(parts);
    return () => sendRtcp(dtls, compound);
  };

const SSRC = [0, 0, 0, 1];
const block = [...SSRC, 255, 127, 255, 255, ...filled(16, 255)];
const report = rtcp(201, 0, SSRC);
const many = (part: Buffer, count: number) => new Array<Buffer>(count).fill(part);
/** Each names 17 lost packets of the stream. */
const lost = times(MANY, (n) => [n >> 3, (n * 17) & 255, 255, 255]);

/** Each RTCP type, and what makes the most work of it; and media. */
export const peerMediaAttacks = repeated({
  'SR: 31 blocks': same(rtcp(200, 31, [...SSRC, ...filled(20, 1), ...times(31, () => block)])),
  'RR: 31 blocks': same(rtcp(201, 31, [...SSRC, ...times(31, () => block)])),
  'SDES: 31 sources, 300 items': same(
    report,
    rtcp(
      202,
      31,
      times(31, () => [...SSRC, ...times(10, () => [1, 1, 65]), 0, 0]),
    ),
  ),
  'BYE: 31 sources': same(
    report,
    rtcp(
      203,
      31,
      times(31, () => SSRC),
    ),
  ),
  APP: same(report, rtcp(204, 1, [...SSRC, 65, 66, 67, 68, ...filled(1000, 1)])),
  'TWCC: 65,535 statuses in 40 bytes': same(losses(65_535)),
  'TWCC: 16,384 statuses': same(losses(16_384)),
  'TWCC: behind a report': same(report, losses(65_535)),
  'TWCC: 30 in a compound': same(...many(losses(65_535), 30)),
  'TWCC: runs of nothing': same(feedback(205, 15, [0, 0, 255, 255, 0, 0, 0, 1, ...filled(1100)])),
  'NACK: 4,760 packets': same(feedback(205, 1, lost)),
  'NACK: behind a report, 20 times': same(report, ...many(feedback(205, 1, lost.slice(0, 48)), 20)),
  TMMBR: same(
    report,
    feedback(
      205,
      3,
      times(140, () => [...SSRC, ...bytes4(1 << 26)]),
    ),
  ),
  'PLI: 60 in a compound': same(...many(feedback(206, 1), 60)),
  'FIR: 140 streams': same(
    feedback(
      206,
      4,
      times(140, (n) => [...SSRC, n, 0, 0, 0]),
    ),
  ),
  'REMB: 255 streams': same(
    feedback(206, 15, [0x52, 0x45, 0x4d, 0x42, 255, 255, 255, 255, ...times(255, () => SSRC)]),
  ),
  XR: same(report, rtcp(207, 0, [...SSRC, ...times(140, () => [4, 0, 0, 1, ...filled(4)])])),
  'unknown types': same(
    report,
    ...[192, 195, 199, 208, 213, 223].map((type) => rtcp(type, 0, filled(100, 1))),
  ),
  'a compound of 64 parts': same(...many(report, 64)),
  'a compound of 280 parts': same(report, ...many(rtcp(205, 1, []), MANY)),
  'a compound of 16,000 parts': same(report, ...many(rtcp(205, 1, []), 15_000)),
  'RTP: 1,000 sources': ({ dtls }) => {
    const payload = Buffer.alloc(1000);
    return (ssrc) => dtls.sendRtp(payload, new RtpHeader({ ssrc, payloadType: 111, sequenceNumber: 1 }));
  },
  'RTP: one stream': ({ dtls }) => {
    const payload = Buffer.alloc(1000);
    return (sequenceNumber) =>
      dtls.sendRtp(payload, new RtpHeader({ ssrc: 9, payloadType: 111, sequenceNumber }));
  },
});
