import { type IceServer, VIDEO_CODECS } from '@farpoint/protocol';
import { ABS_CAPTURE_TIME_URI } from '@farpoint/rtp';
import { RTCPeerConnection, RTCRtpHeaderExtensionParameters, useSdesMid, useTransportWideCC } from 'werift';
import { cloudCodecParameters, videoCodecParameters } from './media-codecs.ts';
import type { OperatorPeerOptions } from './peer-events.ts';

/** Creates a connection that offers the media of a session with a Farpoint operator. */
export function openPeerConnection({
  iceServers,
  icePolicy = 'all',
  portRange,
}: Pick<OperatorPeerOptions, 'iceServers' | 'icePolicy' | 'portRange'>): RTCPeerConnection {
  // All m-lines share these objects, because ids must agree within a bundle.
  const extensions = [useSdesMid(), useTransportWideCC()];
  const captureTime = new RTCRtpHeaderExtensionParameters({ uri: ABS_CAPTURE_TIME_URI });
  return new RTCPeerConnection({
    iceServers: toWeriftServers(iceServers),
    bundlePolicy: 'max-bundle',
    // Points over TCP would arrive late and in bursts. A relay's own use of TCP is another matter.
    iceUseTcp: false,
    iceTransportPolicy: icePolicy,
    ...(portRange === undefined ? {} : { icePortRange: [...portRange] as [number, number] }),
    codecs: { audio: [cloudCodecParameters()], video: VIDEO_CODECS.map(videoCodecParameters) },
    headerExtensions: { audio: extensions, video: [...extensions, captureTime] },
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
