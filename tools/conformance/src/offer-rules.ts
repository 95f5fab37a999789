/** What a robot's SDP offer must contain (docs/protocol.md, "In RTP"). Text in, findings out. */
import { sdpLines, sdpSections } from '@farpoint/reference-profile';
import type { Finding } from './rtp-rules.ts';

const FEEDBACK = ['ccm fir', 'goog-remb', 'nack', 'nack pli', 'transport-cc'];
const TRANSPORT_WIDE_CC = 'http://www.ietf.org/id/draft-holmer-rmcat-transport-wide-cc-extensions-01';

export function checkOffer(sdp: string): Finding[] {
  const sections = sdpSections(sdp);
  const lines = sdpLines(sdp);
  const findings: Finding[] = [];
  const find = (rule: string, detail: string) => findings.push({ rule, detail });
  const kinds = sections.map(({ media }) => media.split(' ')[0]);
  const video = sections[kinds.indexOf('video')];
  if (kinds.filter((kind) => kind === 'video').length !== 1)
    find('one-video-line', `m-lines: ${kinds.join(', ')}`);
  if (kinds.filter((kind) => kind === 'application').length !== 1)
    find('one-application-line', `m-lines: ${kinds.join(', ')}`);
  if (kinds.length !== 2) find('no-other-line', `m-lines: ${kinds.join(', ')}`);
  if (video === undefined) return findings;
  const types = video.media.split(' ').slice(3);
  // A stack may list its other payload types as well; the answer selects this one.
  if (!types.includes('5')) find('payload-type-5', `payload types ${types.join(' ')}`);
  const valuesOf = (name: string) =>
    video.attributes.filter((line) => line.startsWith(`${name}:`)).map((line) => line.slice(name.length + 1));
  const map = valuesOf('rtpmap');
  if (!map.includes('5 pcm/90000')) find('pcm-90000', `rtpmap ${map.join(', ')}`);
  const feedback = valuesOf('rtcp-fb')
    .map((value) => value.split(' '))
    .filter(([type]) => type === '5' || type === '*')
    .map(([, ...rest]) => rest.join(' '))
    .sort();
  for (const wanted of FEEDBACK) if (!feedback.includes(wanted)) find('feedback', `no rtcp-fb ${wanted}`);
  const extensions = valuesOf('extmap');
  if (extensions.join() !== `1 ${TRANSPORT_WIDE_CC}`)
    find('one-extension', `extmap ${extensions.join(', ')}`);
  for (const wanted of ['ice-ufrag', 'ice-pwd', 'fingerprint'])
    if (!lines.some((line) => line.startsWith(`a=${wanted}:`))) find('transport', `no ${wanted}`);
  return findings;
}
