import { REFERENCE_MEDIA } from '@farpoint/protocol';
import { type ConnectionGuardEvents, chooseHostCandidates, guardConnection } from '@farpoint/webrtc';
import {
  RTCPeerConnection,
  RTCRtpCodecParameters,
  useFIR,
  useNACK,
  usePLI,
  useREMB,
  useTransportWideCC,
  useTWCC,
} from 'werift';

export interface ReferencePeerOptions {
  /** None by default. */
  iceServers?: { urls: string; username?: string; credential?: string }[] | undefined;
  /** Local UDP ports, both ends inclusive; any port by default. */
  portRange?: readonly [number, number] | undefined;
  icePolicy?: 'all' | 'relay' | undefined;
}

/**
 * Creates a connection that offers, or accepts, the media of the reference profile: one video m-line of payload type 5,
 * `pcm/90000`, with its feedback and its one header extension. Everything it receives passes the guard.
 */
export function createReferencePeerConnection(
  options: ReferencePeerOptions = {},
  events: ConnectionGuardEvents = {},
): RTCPeerConnection {
  const { portRange } = options;
  const connection = new RTCPeerConnection({
    iceServers: options.iceServers ?? [],
    bundlePolicy: 'max-bundle',
    iceUseTcp: false,
    iceTransportPolicy: options.icePolicy ?? 'all',
    ...(portRange === undefined ? {} : { icePortRange: [...portRange] as [number, number] }),
    codecs: {
      audio: [],
      video: [
        new RTCRtpCodecParameters({
          mimeType: REFERENCE_MEDIA.mimeType,
          clockRate: REFERENCE_MEDIA.clockRate,
          payloadType: REFERENCE_MEDIA.payloadType,
          rtcpFeedback: [useREMB(), useFIR(), useNACK(), usePLI(), useTWCC()],
        }),
      ],
    },
    // The first and only extension: its id is 1.
    headerExtensions: { video: [useTransportWideCC()] },
  });
  chooseHostCandidates(connection);
  guardConnection(connection, events);
  return connection;
}
