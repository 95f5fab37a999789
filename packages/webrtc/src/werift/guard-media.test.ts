/** Which RTP and RTCP reach werift or the tap, at stand-ins for its sessions. */

import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { RTCDtlsTransport } from 'werift';
import { PeerBudget, WATCHER_LIMITS } from '../peer-budget.ts';
import { Refusals } from '../refusal.ts';
import { guardMedia } from './guard-media.ts';
import { tapRtcp } from './media-tap.ts';

/** Deciphers what begins with 0x80 or more; that is itself. */
const session = () => ({
  deciphered: 0,
  decrypt(sealed: Buffer): Buffer {
    if (sealed[0]! < 0x80) throw new Error('not authentic');
    this.deciphered++;
    return sealed;
  },
});

const report = Buffer.from([0x80, 201, 0, 1, 0, 0, 0, 9]);
/** Reports on 16,000 packets. */
const feedback = Buffer.from([0x8f, 205, 0, 4, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 62, 128, 0, 0, 0, 1]);

function rtp(ssrc: number, first = 0x80): Buffer {
  const packet = Buffer.alloc(20, first);
  packet.writeUInt32BE(ssrc, 8);
  return packet;
}

let transport: RTCDtlsTransport;
let srtp: ReturnType<typeof session>;
let srtcp: ReturnType<typeof session>;
let refusals: Refusals;

/** A transport whose media have begun. */
function guarded(rtpSession: object, rtcpSession: object, asked = true): RTCDtlsTransport {
  const shape = { srtp: rtpSession, srtcp: rtcpSession, startSrtp: () => undefined };
  const made = shape as unknown as RTCDtlsTransport;
  guardMedia(made, refusals, new PeerBudget(), asked);
  made.startSrtp();
  return made;
}

beforeEach(() => {
  // A budget fills as time goes on, which it does not within a test.
  vi.useFakeTimers({ toFake: ['performance'] });
  [srtp, srtcp, refusals] = [session(), session(), new Refusals()];
  for (const one of [srtp, srtcp]) one.decrypt = one.decrypt.bind(one);
  transport = guarded(srtp, srtcp);
});

afterEach(() => void vi.useRealTimers());

describe('RTCP', () => {
  it('werift gets reports only', () => {
    expect(srtcp.decrypt(Buffer.concat([report, feedback]))).toEqual(report);
    expect(srtcp.decrypt(feedback)).toHaveLength(0);
  });

  it('a tap gets everything, and werift nothing more', () => {
    const heard: Uint8Array[] = [];
    tapRtcp(transport, (compound) => heard.push(compound));
    const compound = Buffer.concat([report, feedback]);
    expect(srtcp.decrypt(compound)).toHaveLength(0);
    expect(heard).toEqual([compound]);
  });

  it('is dropped beyond the budget, by what it costs', () => {
    let taken = 0;
    while (refusals.get('rtcp-rate-limited') === 0) {
      srtcp.decrypt(feedback);
      taken++;
    }
    // 16,000 statuses cost as much as 62 packets.
    expect(taken - 1).toBe(Math.floor(WATCHER_LIMITS.rtcp.burst! / 63));
  });

  it('is not even deciphered if it is too long, and not read if it has too many parts', () => {
    expect(srtcp.decrypt(Buffer.alloc(4000, 0x80))).toHaveLength(0);
    expect(srtcp.deciphered).toBe(0);
    expect(srtcp.decrypt(Buffer.concat(new Array<Buffer>(200).fill(report)))).toHaveLength(0);
    expect(refusals.get('rtcp-malformed')).toBe(2);
  });

  it('that is not authentic costs the peer nothing', () => {
    for (let n = 0; n < 5000; n++) expect(() => srtcp.decrypt(Buffer.alloc(40))).toThrow('not authentic');
    expect(srtcp.decrypt(report)).toEqual(report);
  });
});

describe('RTCP under AES-GCM', () => {
  /** With a tag and a number, which the stand-in leaves there. */
  function numbered(index: number): Buffer {
    const packet = Buffer.concat([report, Buffer.alloc(20)]);
    packet.writeUInt32BE(index, packet.length - 4);
    return packet;
  }

  it('counts once, whoever repeats it', () => {
    const session = { ...srtcp, remoteContext: { profile: 7 } };
    session.decrypt = (sealed) => {
      if (sealed[8] === 9) throw new Error('not authentic');
      return sealed.subarray(0, 8);
    };
    guarded(srtp, session);
    // One that is forged, with a number to come, does not make that number old.
    const forged = numbered(1);
    forged[8] = 9;
    expect(() => session.decrypt(forged)).toThrow('not authentic');
    expect(session.decrypt(numbered(1))).toEqual(report);
    for (let n = 0; n < 5000; n++) expect(session.decrypt(numbered(1))).toHaveLength(0);
    expect(session.decrypt(numbered(2))).toEqual(report);
    expect(refusals.get('rtcp-replayed')).toBe(5000);
    expect(refusals.get('rtcp-rate-limited')).toBe(0);
  });
});

describe('RTP', () => {
  it('is taken of as many sources as a peer has', () => {
    for (let ssrc = 0; ssrc < 64; ssrc++) expect(srtp.decrypt(rtp(ssrc))).toEqual(rtp(ssrc));
    expect(srtp.decrypt(rtp(64))).not.toEqual(rtp(64));
    expect(srtp.decrypt(rtp(9))).toEqual(rtp(9));
    expect(srtp.deciphered).toBe(65);
    expect(refusals.get('rtp-too-many-sources')).toBe(1);
  });

  it('is not even deciphered if none was asked for', () => {
    const media = session();
    guarded(media, srtcp, false);
    expect(media.decrypt(rtp(1))).not.toEqual(rtp(1));
    expect(media.deciphered).toBe(0);
    expect(refusals.get('rtp-unasked')).toBe(1);
  });

  it('that is not authentic makes no source known', () => {
    for (let ssrc = 100; ssrc < 200; ssrc++)
      expect(() => srtp.decrypt(rtp(ssrc, 0))).toThrow('not authentic');
    expect(srtp.decrypt(rtp(1))).toEqual(rtp(1));
  });
});
