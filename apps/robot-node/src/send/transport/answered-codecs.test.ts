import type { VideoCodec } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readVideoAnswers } from './answered-codecs.ts';

const BOTH: readonly VideoCodec[] = ['H264', 'VP8'];
const PARAMETERS = 'level-asymmetry-allowed=1;packetization-mode=1;profile-level-id=42e01f';
const head = [
  ...['v=0', 'o=- 1 1 IN IP4 0.0.0.0', 's=-', 't=0 0', 'a=group:BUNDLE 0 1 2'],
  ...['m=audio 9 UDP/TLS/RTP/SAVPF 96', 'a=mid:0', 'a=rtpmap:96 opus/48000/2', 'a=fmtp:96 useinbandfec=1'],
];
const tail = ['m=application 9 UDP/DTLS/SCTP webrtc-datachannel', 'a=mid:2'];
const video = [
  ...['m=video 9 UDP/TLS/RTP/SAVPF 97 98', 'c=IN IP4 0.0.0.0', 'a=mid:1', 'a=recvonly', 'a=rtcp-mux'],
  ...[
    'a=rtpmap:97 H264/90000',
    'a=rtcp-fb:97 nack pli',
    'a=rtcp-fb:97 transport-cc',
    `a=fmtp:97 ${PARAMETERS}`,
  ],
  ...['a=rtpmap:98 VP8/90000', 'a=rtcp-fb:98 nack pli', 'a=rtcp-fb:98 transport-cc'],
];
const sdpOf = (...videos: readonly (readonly string[])[]) =>
  [...head, ...videos.flat(), ...tail].map((line) => `${line}\r\n`).join('');
const replaced = (from: string, to: string) => video.map((line) => line.replace(from, to));

function read(lines: readonly string[], offered = BOTH) {
  const { videos, sdp } = readVideoAnswers(sdpOf(lines), [offered]);
  const { payloadTypes, refusal } = videos[0]!;
  return { said: refusal ?? Object.fromEntries(payloadTypes), sdp };
}

describe('an answer to a video', () => {
  it('passes as it is if all of it can be used', () => {
    expect(read(video)).toEqual({ said: { H264: 97, VP8: 98 }, sdp: sdpOf(video) });
  });

  it.each([
    ['in the operator’s own numbers', replaced('98', '120'), { H264: 97, VP8: 120 }],
    ['with one codec', replaced('97 98', '98'), { VP8: 98 }],
    ['in small letters', replaced('VP8/', 'vp8/'), { H264: 97, VP8: 98 }],
    ['with codecs that were never offered', [...video, 'a=rtpmap:99 AV1/90000'], { H264: 97, VP8: 98 }],
    ['with lines for payload types that nobody listed', [...video, 'a=fmtp:77 x=1'], { H264: 97, VP8: 98 }],
    ['with a payload type that is listed and not explained', replaced('97 98', '99 98'), { VP8: 98 }],
    ['with one that is listed twice', replaced('97 98', '98 98 97'), { H264: 97, VP8: 98 }],
    ['in H.264 of another profile, and VP8', replaced('42e01f', '640c1f'), { VP8: 98 }],
    ['in H.264 of another packetization mode, and VP8', replaced('mode=1', 'mode=0'), { VP8: 98 }],
    ['in constrained baseline by another name', replaced('42e01f', '4d801f'), { H264: 97, VP8: 98 }],
    [
      'in two profiles of H.264',
      [
        ...replaced('97 98', '99 97 98'),
        ...['a=rtpmap:99 H264/90000', 'a=fmtp:99 profile-level-id=64001f;packetization-mode=1'],
      ],
      { H264: 97, VP8: 98 },
    ],
  ])('%s', (_, lines, said) => {
    expect(read(lines).said).toEqual(said);
  });

  it.each([
    ['refused', replaced('video 9', 'video 0')],
    ['bad-line', replaced('video 9', 'video nine')],
    ['bad-line', replaced('UDP/TLS/RTP/SAVPF', '%')],
    ['bad-line', replaced('video 9', 'video 99999999999999999999')],
    ['no-common-codec', replaced('97 98', '99')],
    ['no-common-codec', video.map((line) => line.replace(/H264|VP8/, 'AV1'))],
    ['no-common-codec', video.map((line) => line.replace('/90000', '/1e99'))],
    ['bad-payload-type', video.map((line) => line.replaceAll('97', '300').replaceAll('98', '72'))],
    ['bad-payload-type', video.map((line) => line.replaceAll('97', '-1').replaceAll('98', '098'))],
    ['ambiguous-payload-type', [...replaced('97 98', '97'), 'a=rtpmap:97 VP8/90000']],
    ['other-parameters', replaced('97 98', '97').map((line) => line.replace('42e01f', 'zz'))],
    ['other-parameters', replaced('97 98', '97').filter((line) => !line.startsWith('a=fmtp'))],
  ])('without a usable codec is %s', (refusal, lines) => {
    const { said, sdp } = read(lines);
    expect(said).toBe(refusal);
    expect(sdp).toContain('m=video 0 UDP/TLS/RTP/SAVPF 0\r\nc=IN IP4 0.0.0.0\r\na=inactive\r\na=mid:1\r\n');
    expect(sdp).toContain('a=group:BUNDLE 0 2\r\n');
    expect(sdp).not.toMatch(/H264|VP8/);
  });

  it('that names a codec which only another video offers is refused', () => {
    expect(read(replaced('97 98', '97'), ['VP8']).said).toBe('no-common-codec');
  });

  it('loses what werift would stumble over, and nothing else', () => {
    const { sdp } = read([
      ...video,
      ...['a=fmtp:77 x=1', 'a=rtpmap:', 'a=rtcp-fb:97', 'a=rtcp-fb:98 ', 'a=rtpmap:97 H264/90000', 'a=fmtp'],
    ]);
    expect(sdp).toBe(sdpOf(video));
  });

  it('is read for each video by itself', () => {
    const second = replaced('97 98', '5');
    const { videos } = readVideoAnswers(sdpOf(video, second, video), [BOTH, BOTH, ['VP8']]);
    expect(videos.map(({ payloadTypes }) => [...payloadTypes])).toEqual([
      [
        ['H264', 97],
        ['VP8', 98],
      ],
      [],
      [['VP8', 98]],
    ]);
  });

  it('keeps the m-lines of any text, and gives only dynamic payload types', () => {
    const lines = fc.oneof(
      fc.string(),
      fc.constantFrom(...head, ...video, ...tail),
      fc
        .tuple(
          fc.constantFrom('rtpmap', 'fmtp', 'rtcp-fb'),
          fc.integer(),
          fc.constantFrom(...BOTH, PARAMETERS),
        )
        .map(([kind, format, value]) => `a=${kind}:${format} ${value}/90000`),
    );
    fc.assert(
      fc.property(fc.array(lines), (some) => {
        const text = sdpOf([video[0]!, ...some]);
        const { videos, sdp } = readVideoAnswers(text, [BOTH]);
        const kinds = (sdpText: string) => sdpText.match(/^m=\S*/gm);
        expect(kinds(sdp)).toEqual(kinds(text.replaceAll('\n\r\n', '\r\n')));
        for (const { payloadTypes, refusal } of videos) {
          expect(refusal === null).toBe(payloadTypes.size > 0);
          for (const type of payloadTypes.values()) expect(type >= 35 && type <= 127).toBe(true);
        }
      }),
    );
  });
});
