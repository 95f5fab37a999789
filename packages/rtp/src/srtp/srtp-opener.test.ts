import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RtpHeader, SrtpSession } from 'werift';
import { emptyRtpHeader, readRtpHeader } from '../rtp-header.ts';
import { SrtpOpener } from './srtp-opener.ts';

const masterKey = Buffer.from('000102030405060708090a0b0c0d0e0f', 'hex');
const masterSalt = Buffer.from('a0a1a2a3a4a5a6a7a8a9aaab', 'hex');

/** The sender is werift's own implementation. */
function session() {
  const keys = {
    localMasterKey: masterKey,
    localMasterSalt: masterSalt,
    remoteMasterKey: masterKey,
    remoteMasterSalt: masterSalt,
  };
  const sender = new SrtpSession({ keys, profile: 7 });
  const { srtpSessionKey, srtpSessionSalt } = sender.remoteContext;
  const opener = new SrtpOpener(srtpSessionKey, srtpSessionSalt);
  const seal = (sequence: number, payload: Uint8Array, ssrc = 0xdeadbeef) => {
    const header = new RtpHeader({ payloadType: 5, sequenceNumber: sequence & 0xffff, timestamp: 1, ssrc });
    return sender.encrypt(Buffer.from(payload), header);
  };
  return { opener, seal };
}

describe('SrtpOpener', () => {
  it('decrypts what another implementation encrypted, past wraps, out of order within its window, once', () => {
    const { opener, seal } = session();
    // All of those around both wraps; between them, jumps that are no longer than a receiver can follow.
    const isSent = (i: number) => i < 1000 || (i > 65_700 && i < 66_700) || i % 8192 === 0;
    const packets = Array.from({ length: 70_000 }, (_, i) => i)
      .filter(isSent)
      .map((i) => ({ i, packet: seal(65_000 + i, new Uint8Array([i & 0xff, i >> 8])) }));
    // Every tenth packet arrives three packets later.
    const order = packets
      .map(({ i, packet }, at) => ({ packet, i, at: at + (i % 10 === 0 && i % 8192 !== 0 ? 3.5 : 0) }))
      .sort((a, b) => a.at - b.at);
    for (const { packet, i } of order) {
      const payload = opener.open(packet, 12);
      if (payload?.[0] !== (i & 0xff)) throw new Error(`packet ${i}`);
    }
    expect(opener.drops).toEqual({});
    for (const { packet } of packets.slice(-2)) expect(opener.open(packet, 12)).toBeNull();
    expect(opener.drops).toEqual({ replayed: 2 });
  }, 30_000);

  it('refuses every modified packet, and continues', () => {
    const { opener, seal } = session();
    let sequence = 0;
    fc.assert(
      fc.property(fc.nat(27), fc.integer({ min: 1, max: 255 }), (at, flip) => {
        const packet = seal(sequence++, new Uint8Array(40));
        const changed = Buffer.from(packet);
        // Except the high bits of the sequence number and the SSRC: they select the key stream, not only this packet's
        // fate.
        changed[at] = (changed[at] as number) ^ flip;
        expect(opener.open(changed, 12)).toBeNull();
        expect(opener.open(packet, 12)).not.toBeNull();
      }),
      longProperty(6, 800),
    );
  });

  it('accepts any bytes without throwing', () => {
    const { opener } = session();
    const header = emptyRtpHeader();
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 80 }), (bytes) => {
        const packet = Buffer.from(bytes);
        if (readRtpHeader(packet, 1, header)) expect(opener.open(packet, header.bytes)).toBeNull();
      }),
      longProperty(7, 4000),
    );
  });
});
