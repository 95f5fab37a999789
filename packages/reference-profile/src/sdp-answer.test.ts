import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { answerMisfit } from './sdp-answer.ts';

const OFFER = [
  'v=0',
  'm=video 9 UDP/TLS/RTP/SAVPF 5 96',
  'a=ice-ufrag:x',
  'a=ice-pwd:y',
  'a=fingerprint:sha-256 00',
  'm=application 9 UDP/DTLS/SCTP webrtc-datachannel',
  '',
].join('\r\n');
const ANSWER = OFFER.replace(' 5 96', ' 5');

describe('answerMisfit', () => {
  it('accepts an answer to the offer, with or without trailing blanks', () => {
    expect(answerMisfit(OFFER, ANSWER)).toBeNull();
    expect(answerMisfit(OFFER, ANSWER.replaceAll('\r\n', ' \r\n'))).toBeNull();
    expect(answerMisfit(OFFER, ANSWER.replaceAll('\r\n', '\n'))).toBeNull();
  });

  it.each([
    ['no m-line', ANSWER.replaceAll('m=', 'x='), 'other-m-lines'],
    ['one more', `${ANSWER}m=audio 9 UDP/TLS/RTP/SAVPF 0\r\n`, 'other-m-lines'],
    ['another order', ANSWER.replace('m=video', 'm=audio'), 'other-m-lines'],
    ['a refused video line', ANSWER.replace('m=video 9', 'm=video 0'), 'no-video'],
    ['another payload type', ANSWER.replace('SAVPF 5', 'SAVPF 96'), 'no-video'],
    ['no password', ANSWER.replace('a=ice-pwd', 'a=x'), 'no-transport'],
    ['no fingerprint', ANSWER.replace('a=fingerprint', 'a=x'), 'no-transport'],
  ])('refuses %s', (_what, answer, misfit) => {
    expect(answerMisfit(OFFER, answer)).toBe(misfit);
  });

  it('returns a verdict for any text', () => {
    fc.assert(fc.property(fc.string(), (text) => answerMisfit(OFFER, text) !== null));
  });
});
