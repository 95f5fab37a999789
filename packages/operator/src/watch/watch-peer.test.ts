import { expect, test } from 'vitest';
import { separateStreams } from './watch-peer.ts';

test('names each stream after its track, and changes nothing else', () => {
  const sdp = (cloud: string, video: string) =>
    [
      'a=msid-semantic: WMS *',
      'm=audio 9 UDP/TLS/RTP/SAVPF 111',
      `a=msid:${cloud} januscloud`,
      'm=video 9 UDP/TLS/RTP/SAVPF 96',
      `a=msid:${video} janusv0`,
      'a=ssrc:7 msid:janus janusv0',
      '',
    ].join('\r\n');
  expect(separateStreams(sdp('janus', 'janus'))).toBe(sdp('farpoint-januscloud', 'farpoint-janusv0'));
});
