import { CLOUD_MEDIA, type IceServer } from '@farpoint/protocol';
import {
  RTCPeerConnection,
  RTCRtpCodecParameters,
  useNACK,
  useREMB,
  useSdesMid,
  useTransportWideCC,
  useTWCC,
} from 'werift';
import type { OperatorPeerOptions } from './peer-events.ts';

/** Creates a connection that offers the media of a session with a Farpoint operator. */
export function openPeerConnection({
  iceServers,
  icePolicy = 'all',
  portRange,
}: Pick<OperatorPeerOptions, 'iceServers' | 'icePolicy' | 'portRange'>): RTCPeerConnection {
  // Both m-lines share these objects, because ids must agree within a bundle.
  const extensions = [useSdesMid(), useTransportWideCC()];
  const { mimeType, clockRate, channels } = CLOUD_MEDIA;
  return new RTCPeerConnection({
    iceServers: toWeriftServers(iceServers),
    bundlePolicy: 'max-bundle',
    // Points over TCP would arrive late and in bursts. A relay's own use of TCP is another matter.
    iceUseTcp: false,
    iceTransportPolicy: icePolicy,
    ...(portRange === undefined ? {} : { icePortRange: [...portRange] as [number, number] }),
    codecs: {
      audio: [
        new RTCRtpCodecParameters({
          ...{ mimeType, clockRate, channels },
          // REMB for peers that support nothing better.
          rtcpFeedback: [useTWCC(), useNACK(), useREMB()],
        }),
      ],
      video: [
        new RTCRtpCodecParameters({ mimeType: 'video/VP8', clockRate: 90_000, rtcpFeedback: [useTWCC()] }),
      ],
    },
    headerExtensions: { audio: extensions, video: extensions },
  });
}

export function toWeriftServers(servers: readonly IceServer[]) {
  return servers.flatMap(({ urls, username, credential }) =>
    [urls].flat().map((url) => ({
      urls: url,
      ...(username === undefined ? {} : { username }),
      ...(credential === undefined ? {} : { credential }),
    })),
  );
}

export function errorText(error: unknown): string {
  return (error instanceof Error ? error.message : String(error)).slice(0, 300);
}
