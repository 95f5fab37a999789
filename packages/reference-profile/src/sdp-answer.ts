/** Checks that an SDP answer belongs to an offer of the reference profile (RFC 3264 §6). Text in, reason out. */
import { REFERENCE_MEDIA } from '@farpoint/protocol';
import { sdpLines, sdpSections } from './sdp-sections.ts';

export type AnswerMisfit =
  | 'other-m-lines' // not those of the offer, in the same order
  | 'no-video' // it rejects the points
  | 'no-transport'; // no ICE credentials, or no certificate fingerprint

const TRANSPORT = ['a=ice-ufrag:', 'a=ice-pwd:', 'a=fingerprint:'];

/** @returns why it is no answer to this offer, or `null` */
export function answerMisfit(offer: string, answer: string): AnswerMisfit | null {
  const kinds = (sdp: string) => sdpSections(sdp).map(({ media }) => media.split(' ')[0]);
  if (kinds(offer).join() !== kinds(answer).join()) return 'other-m-lines';
  const video = sdpSections(answer).find(({ media }) => media.startsWith('video '));
  const [, port, , ...types] = video?.media.split(' ') ?? [];
  if (port === '0' || !types.includes(String(REFERENCE_MEDIA.payloadType))) return 'no-video';
  const lines = sdpLines(answer);
  const hasTransport = TRANSPORT.every((start) => lines.some((line) => line.startsWith(start)));
  return hasTransport ? null : 'no-transport';
}
