import { FULL_POINT_PACKET_BYTES } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { knownFrame, readKnownFrame } from './frames.ts';
import { checkOffer } from './offer-rules.ts';
import { RtpStreamRules } from './rtp-rules.ts';

const OFFER = [
  'v=0',
  'm=video 9 UDP/TLS/RTP/SAVPF 5',
  'a=ice-ufrag:x',
  'a=ice-pwd:y',
  'a=fingerprint:sha-256 00',
  'a=rtpmap:5 pcm/90000',
  ...['goog-remb', 'ccm fir', 'nack', 'nack pli', 'transport-cc'].map((kind) => `a=rtcp-fb:5 ${kind}`),
  'a=extmap:1 http://www.ietf.org/id/draft-holmer-rmcat-transport-wide-cc-extensions-01',
  'm=application 9 UDP/DTLS/SCTP webrtc-datachannel',
  '',
].join('\r\n');

const rulesOf = (sdp: string) => checkOffer(sdp).map(({ rule }) => rule);

describe('checkOffer', () => {
  it('finds nothing wrong with the reference profile', () => {
    expect(checkOffer(OFFER)).toEqual([]);
  });

  it('accepts the offer of a stack that lists its other payload types, and ends attribute lines with a blank', () => {
    const offer = OFFER.replace('SAVPF 5', 'SAVPF 96 5 97')
      .replace('a=rtpmap', 'a=rtpmap:96 VP8/90000\r\na=rtcp-fb:96 nack \r\na=rtpmap')
      .replaceAll(/(a=rtcp-fb:5 .*)\r/g, '$1 \r');
    expect(checkOffer(offer)).toEqual([]);
  });

  it.each([
    ['pcm/90000', 'pcm/48000', 'pcm-90000'],
    ['SAVPF 5', 'SAVPF 96', 'payload-type-5'],
    ['a=rtcp-fb:5 ccm fir', 'a=x', 'feedback'],
    ['extmap:1 ', 'extmap:2 ', 'one-extension'],
    ['m=application 9', 'm=audio 9', 'one-application-line'],
    ['a=fingerprint', 'a=finger', 'transport'],
  ])('%s → %s: %s', (from, to, rule) => {
    expect(rulesOf(OFFER.replace(from, to))).toContain(rule);
  });
});

/** A frame's packets as they should be. */
function packets(frame: number, points: number, sequence: number, timestamp: number): Uint8Array[] {
  const payloads = knownFrame(frame, points);
  return payloads.map((payload, i) => {
    const packet = new Uint8Array(20 + FULL_POINT_PACKET_BYTES);
    const view = new DataView(packet.buffer);
    view.setUint8(0, 0x90);
    view.setUint8(1, 5 | (i === payloads.length - 1 ? 0x80 : 0));
    view.setUint16(2, sequence + i);
    view.setUint32(4, timestamp);
    view.setUint32(12, 0xbede0001);
    view.setUint32(16, 0x11000000 | ((sequence + i) << 8));
    packet.set(payload, 20);
    return packet;
  });
}

function findingsOf(stream: Uint8Array[]): string[] {
  const rules = new RtpStreamRules();
  for (const packet of stream) rules.add(packet);
  return [...new Set(rules.findings.map(({ rule }) => rule))];
}

function changed(packet: Uint8Array, at: number, value: number): Uint8Array {
  const copy = packet.slice();
  copy[at] = value;
  return copy;
}

describe('RtpStreamRules', () => {
  const [a, b] = packets(0, 300, 10, 1000) as [Uint8Array, Uint8Array];
  const [c] = packets(1, 150, 12, 2000) as [Uint8Array];

  it('finds nothing wrong with a correct stream', () => {
    expect(findingsOf([a, b, c])).toEqual([]);
  });

  it.each([
    ['a header of 12 bytes', [a.subarray(8)], 'packet-bytes'],
    ['another payload type', [changed(a, 1, 96)], 'payload-type'],
    ['another extension', [changed(a, 12, 0x10)], 'extension'],
    ['a second element', [changed(a, 19, 0x20)], 'extension-element'],
    ['frames that begin at 1', [c], 'from-zero'],
    ['a frame that is left out', [a, b, ...packets(2, 150, 12, 2000)], 'frame-number'],
    ['a timestamp that does not advance', [a, b, ...packets(1, 150, 12, 1000)], 'timestamp'],
    ['a marker too early', [changed(a, 1, 0x85), b], 'marker'],
    ['no marker', [a, changed(b, 1, 5)], 'marker'],
    ['a partial packet', packets(0, 200, 10, 1000), 'whole-packets'],
    ['a block beyond its frame', [changed(a, 29, 0xff)], 'point-header'],
  ])('%s', (_what, stream, rule) => {
    expect(findingsOf(stream)).toContain(rule);
  });
});

it('readKnownFrame detects points of another frame or place', () => {
  const [payload] = knownFrame(3, 150) as [Uint8Array];
  const message = payload.slice(16);
  expect(readKnownFrame(message)).toMatchObject({
    frame: 3,
    strays: 0,
    places: Array.from({ length: 150 }, (_, i) => i),
  });
  message[6] = 4;
  expect(readKnownFrame(message).strays).toBe(1);
});
