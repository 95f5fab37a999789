import fc from 'fast-check';
import { expect, it } from 'vitest';
import { answerFault } from './answer-fault.ts';

const good = [
  ...['v=0', 'o=- 1 1 IN IP4 0.0.0.0', 's=-', 't=0 0', 'a=group:BUNDLE 0 1 2'],
  ...['m=audio 9 UDP/TLS/RTP/SAVPF 96', 'a=mid:0', 'a=ice-ufrag:abcd', 'a=ice-pwd:p'],
  ...['a=fingerprint:sha-256 AA', 'm=video 0 UDP/TLS/RTP/SAVPF 97', 'a=mid:1'],
  ...['m=application 9 UDP/DTLS/SCTP webrtc-datachannel', 'a=mid:2'],
];
const without = (start: string) => good.filter((line) => !line.startsWith(start));
const changed = (from: string, to: string) => good.map((line) => line.replace(from, to));

it.each([
  [good, null],
  [[], 'no SDP: it does not begin with v=0'],
  [['v=0', 'nonsense'], '0 m-lines, where the offer has 3'],
  [without('m=video'), '2 m-lines, where the offer has 3'],
  [changed('m=video', 'm=audio'), 'm-line 2 is audio, where the offer has video'],
  [changed('m=audio 9', 'm=audio 0'), 'the cloud is refused (m=audio has port 0)'],
  [changed('m=application 9', 'm=application 0'), 'the data channels are refused (m=application has port 0)'],
  [without('a=fingerprint'), 'no a=fingerprint'],
  [without('a=ice-pwd'), 'no a=ice-pwd'],
] as const)('%#', (lines, fault) => {
  expect(answerFault(lines.join('\r\n'), 1)).toBe(fault);
  expect(answerFault(lines.join('\n'), 1)).toBe(fault);
});

it('knows how many video lines the offer had, any of which may be refused', () => {
  const video = good.slice(10, 12);
  const two = [...good.slice(0, 10), ...video, ...video, ...good.slice(12)].join('\n');
  expect(answerFault(two, 2)).toBeNull();
  expect(answerFault(two, 1)).toBe('4 m-lines, where the offer has 3');
  expect(answerFault(good.join('\n'), 2)).toBe('3 m-lines, where the offer has 4');
});

it('returns a short fault or none for any text', () => {
  fc.assert(
    fc.property(fc.array(fc.oneof(fc.string(), fc.constantFrom(...good))), (lines) => {
      expect((answerFault(lines.join('\n'), 1) ?? '').length).toBeLessThan(100);
    }),
    { seed: 3 },
  );
});

it('a line for sound follows those of videos, and may be refused', () => {
  const answer = (port: number) =>
    [
      ...['v=0', 'a=ice-ufrag:a', 'a=ice-pwd:b', 'a=fingerprint:sha-256 c'],
      ...['m=audio 9 X 96', 'm=video 9 X 97', `m=audio ${port} X 96`, 'm=application 9 X y'],
    ].join('\r\n');
  expect(answerFault(answer(9), 1, true)).toBe(null);
  expect(answerFault(answer(0), 1, true)).toBe(null);
  expect(answerFault(answer(9), 1)).toBe('4 m-lines, where the offer has 3');
});
