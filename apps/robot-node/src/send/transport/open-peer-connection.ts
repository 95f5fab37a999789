import { type IceCandidate, type IceServer, VIDEO_CODECS } from '@farpoint/protocol';
import { ABS_CAPTURE_TIME_URI } from '@farpoint/rtp';
import { chooseHostCandidates } from '@farpoint/webrtc';
import {
  type RTCIceCandidate,
  RTCPeerConnection,
  RTCRtpHeaderExtensionParameters,
  useSdesMid,
  useTransportWideCC,
} from 'werift';
import { cloudCodecParameters, videoCodecParameters } from './media-codecs.ts';
import type { OperatorPeerOptions } from './peer-events.ts';

/** Creates a connection that offers the media of a session with a Farpoint operator. */
export function openPeerConnection({
  iceServers,
  icePolicy = 'all',
  portRange,
  sound = false,
}: Pick<OperatorPeerOptions, 'iceServers' | 'icePolicy' | 'portRange' | 'sound'>): RTCPeerConnection {
  // All m-lines share these objects, because ids must agree within a bundle.
  const extensions = [useSdesMid(), useTransportWideCC()];
  const captureTime = new RTCRtpHeaderExtensionParameters({ uri: ABS_CAPTURE_TIME_URI });
  const connection = new RTCPeerConnection({
    iceServers: toWeriftServers(iceServers),
    bundlePolicy: 'max-bundle',
    // Points over TCP would arrive late and in bursts. A relay's own use of TCP is another matter.
    iceUseTcp: false,
    iceTransportPolicy: icePolicy,
    ...(portRange === undefined ? {} : { icePortRange: [...portRange] as [number, number] }),
    codecs: { audio: [cloudCodecParameters(sound)], video: VIDEO_CODECS.map(videoCodecParameters) },
    headerExtensions: {
      audio: sound ? [...extensions, captureTime] : extensions,
      video: [...extensions, captureTime],
    },
  });
  chooseHostCandidates(connection);
  return connection;
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

/** What the operator is told of one of our candidates. */
export function candidateOf(candidate: RTCIceCandidate): IceCandidate {
  const { candidate: text, sdpMid, sdpMLineIndex, usernameFragment } = candidate.toJSON();
  return {
    candidate: text,
    sdpMid: sdpMid ?? null,
    sdpMLineIndex: sdpMLineIndex ?? null,
    // Tells the operator which generation the candidate belongs to, in case it arrives late.
    usernameFragment: usernameFragment ?? null,
  };
}

export function errorText(error: unknown): string {
  return (error instanceof Error ? error.message : String(error)).slice(0, 300);
}
