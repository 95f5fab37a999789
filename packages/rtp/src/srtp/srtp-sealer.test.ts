import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RtpPacket, SrtpSession } from 'werift';
import { RtpHeaderTemplate } from '../rtp-header-template.ts';
import { SrtpSealer } from './srtp-sealer.ts';

const masterKey = Buffer.from('000102030405060708090a0b0c0d0e0f', 'hex');
const masterSalt = Buffer.from('a0a1a2a3a4a5a6a7a8a9aaab', 'hex');
const SSRC = 0xdeadbeef;

/** Both ends of one SRTP session; the receiver is werift's own implementation. */
function session(firstSequence: number) {
  const keys = {
    localMasterKey: masterKey,
    localMasterSalt: masterSalt,
    remoteMasterKey: masterKey,
    remoteMasterSalt: masterSalt,
  };
  const receiver = new SrtpSession({ keys, profile: 7 });
  const { srtpSessionKey, srtpSessionSalt } = receiver.localContext;
  const header = new RtpHeaderTemplate({
    payloadType: 96,
    ssrc: SSRC,
    mid: '0',
    midExtensionId: 1,
    transportSequenceExtensionId: 2,
  });
  const sealer = new SrtpSealer(srtpSessionKey, srtpSessionSalt, SSRC, firstSequence);
  const send = (payload: Uint8Array, marker: boolean, timestamp: number, transportSequence: number) => {
    header.patch(marker, sealer.nextSequence, timestamp, transportSequence);
    return Buffer.concat(sealer.seal(Buffer.from(header.bytes), payload));
  };
  return { receiver, send };
}

describe('SrtpSealer and RtpHeaderTemplate', () => {
  it('make packets that another implementation decrypts', () => {
    const { receiver, send } = session(7);
    fc.assert(
      fc.property(
        fc.uint8Array({ minLength: 1, maxLength: 1244 }),
        fc.boolean(),
        fc.nat(0xffffffff),
        fc.nat(0xffff),
        (payload, marker, timestamp, transportSequence) => {
          const opened = RtpPacket.deSerialize(
            receiver.decrypt(send(payload, marker, timestamp, transportSequence)),
          );
          expect(new Uint8Array(opened.payload)).toEqual(payload);
          expect(opened.header).toMatchObject({ marker, timestamp, ssrc: SSRC, payloadType: 96 });
          const [mid, wide] = [1, 2].map((id) => opened.header.extensions.find((e) => e.id === id)?.payload);
          expect(mid?.toString('ascii')).toBe('0');
          expect(wide?.readUInt16BE()).toBe(transportSequence);
        },
      ),
      { seed: 8 },
    );
  });

  it('continue past the wrap of the sequence number', () => {
    const { receiver, send } = session(0x7fff);
    const payload = Uint8Array.of(1, 2, 3);
    for (let i = 0; i < 0x8100; i++) {
      const packet = send(payload, false, 0, 0);
      // Decrypting each of 33,000 packets takes seconds; a sample, and those around the wrap, are enough.
      const sequence = packet.readUInt16BE(2);
      if (sequence > 16 && sequence < 0xfff0 && i % 4096 !== 0) continue;
      const opened = RtpPacket.deSerialize(receiver.decrypt(packet));
      expect(opened.header.sequenceNumber).toBe((0x7fff + i) & 0xffff);
      expect(new Uint8Array(opened.payload)).toEqual(payload);
    }
  });

  it('make packets that are refused with a flipped bit', () => {
    const { receiver, send } = session(0);
    const packet = send(Uint8Array.of(1, 2, 3), false, 0, 0);
    packet[packet.length - 20] = (packet[packet.length - 20] as number) ^ 1;
    expect(() => receiver.decrypt(packet)).toThrow();
  });

  it('leave out extensions that the peer refused', () => {
    const header = new RtpHeaderTemplate({ payloadType: 1, ssrc: 1, mid: 'cloud' });
    header.patch(true, 2, 3, 4);
    expect(header.bytes.length).toBe(16);
    expect(RtpPacket.deSerialize(Buffer.concat([header.bytes, Buffer.of(9)])).payload).toEqual(Buffer.of(9));
  });

  it('refuse keys of the wrong length', () => {
    expect(() => new SrtpSealer(new Uint8Array(15), new Uint8Array(12), 1, 0)).toThrow(RangeError);
    expect(() => new SrtpSealer(new Uint8Array(16), new Uint8Array(11), 1, 0)).toThrow(RangeError);
  });
});
