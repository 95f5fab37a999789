import { SRTP_AEAD_AES_128_GCM } from '@farpoint/rtp/srtp';
import type { RTCDtlsTransport } from 'werift';
import type { PeerBudget } from '../peer-budget.ts';
import type { Refusals } from '../refusal.ts';
import { compoundWork, leadingReport, MAX_COMPOUND_BYTES } from '../rtcp/compound-work.ts';
import { ReplayedRtcp } from '../rtcp/replayed-rtcp.ts';
import { isRtcpTapped, NO_RTCP, NO_RTP } from './media-tap.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

/** Streams of a peer: camera pictures, clouds, sound; werift remembers each SSRC for ever. */
const MAX_SOURCES = 64;
/** What SRTCP adds: tag, index (RFC 7714 §9.2, RFC 3711 §3.4). */
const SRTCP_BYTES = 20;
const SSRC_AT = 8;

/**
 * Bounds the RTP and RTCP of a peer as soon as there are keys for it. What is dropped was authentic, so that nobody
 * else can use up the peer's budget.
 *
 * Of RTCP, werift itself gets nothing but reports.
 *
 * @throws {WeriftShapeError}
 */
export function guardMedia(
  transport: RTCDtlsTransport,
  refusals: Refusals,
  budget: PeerBudget,
  takesRtp = true,
): void {
  expectMethods(transport, 'the DTLS transport', ['startSrtp']);
  const start = transport.startSrtp.bind(transport);
  transport.startSrtp = () => {
    start();
    const { srtp, srtcp } = transport;
    if (srtp === undefined || srtcp === undefined) throw new WeriftShapeError('no SRTP after its start');
    expectMethods(srtp, 'the SRTP session', ['decrypt']);
    expectMethods(srtcp, 'the SRTCP session', ['decrypt']);

    const decipherRtcp = srtcp.decrypt;
    const replayed = srtcp.remoteContext?.profile === SRTP_AEAD_AES_128_GCM ? new ReplayedRtcp() : null;
    srtcp.decrypt = (sealed) => {
      if (sealed.length > MAX_COMPOUND_BYTES + SRTCP_BYTES) {
        refusals.add('rtcp-malformed');
        return NO_RTCP;
      }
      if (replayed?.has(sealed) === true) {
        refusals.add('rtcp-replayed');
        return NO_RTCP;
      }
      const compound = decipherRtcp(sealed);
      replayed?.mark(sealed);
      const work = compoundWork(compound);
      if (work === null) refusals.add('rtcp-malformed');
      else if (!budget.take('rtcp', work, performance.now())) refusals.add('rtcp-rate-limited');
      else return isRtcpTapped(transport) ? compound : leadingReport(compound);
      return NO_RTCP;
    };

    const decipherRtp = srtp.decrypt;
    const sources = new Set<number>();
    srtp.decrypt = (sealed) => {
      if (!takesRtp) {
        refusals.add('rtp-unasked');
        return NO_RTP;
      }
      const ssrc = sealed.length < SSRC_AT + 4 ? 0 : sealed.readUInt32BE(SSRC_AT);
      const isKnown = sources.has(ssrc);
      if (!isKnown && sources.size >= MAX_SOURCES) {
        refusals.add('rtp-too-many-sources');
        return NO_RTP;
      }
      const packet = decipherRtp(sealed);
      if (!isKnown) sources.add(ssrc);
      return packet;
    };
  };
}
