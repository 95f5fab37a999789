import type { Buffer } from 'node:buffer';
import type { RTCDtlsTransport } from 'werift';

/** Hands every decrypted RTP packet to `tap`, header and all, before werift parses it. @throws {Error} for a werift built otherwise */
export function tapRtp(dtls: RTCDtlsTransport, tap: (packet: Buffer) => void): void {
  const { srtp } = dtls;
  if (typeof srtp?.decrypt !== 'function') throw new Error('no SRTP context after DTLS connected');
  const decrypt = srtp.decrypt;
  srtp.decrypt = (data: Buffer) => {
    const packet = decrypt(data);
    tap(packet);
    return packet;
  };
}
