/** Sends packets again that a peer reports as missing, byte for byte. The guard keeps such reports from werift itself. */
import { FMT_GENERIC_NACK, RTCP_TRANSPORT_FEEDBACK, readNack, walkRtcp } from '@farpoint/rtp';
import { tapRtcp } from '@farpoint/webrtc';
import type { RTCDtlsTransport, RtpHeader } from 'werift';

/** Packets that are kept: several frames. */
const KEPT = 1024;

/** @param dtls connected, of a connection that sends one stream */
export function retransmit(dtls: RTCDtlsTransport): void {
  const kept: { payload: Buffer; header: RtpHeader }[] = [];
  const send = dtls.sendRtp.bind(dtls);
  dtls.sendRtp = (payload, header) => {
    kept[header.sequenceNumber % KEPT] = { payload, header };
    return send(payload, header);
  };
  const resend = (sequence: number) => {
    const packet = kept[sequence % KEPT];
    if (packet?.header.sequenceNumber === sequence)
      send(packet.payload, packet.header).catch(() => undefined);
  };
  tapRtcp(dtls, (compound) => {
    for (const { packetType, format, bytes } of walkRtcp(compound, () => undefined))
      if (packetType === RTCP_TRANSPORT_FEEDBACK && format === FMT_GENERIC_NACK) readNack(bytes, resend);
  });
}
