import { REFERENCE_MEDIA } from '@farpoint/protocol';
import { type ConnectionGuardEvents, guardConnection } from '@farpoint/webrtc';
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
  /** None where left out. */
  iceServers?: { urls: string; username?: string; credential?: string }[] | undefined;
  /** Local UDP ports, both ends included; any where left out. */
  portRange?: readonly [number, number] | undefined;
  icePolicy?: 'all' | 'relay' | undefined;
}

/**
 * A connection that offers, or takes, the media of the reference profile: one video m-line of payload type 5, `pcm/90000`,
 * with its feedback and its one header extension. What it hears is guarded.
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
    // The first and only one: its id is 1.
    headerExtensions: { video: [useTransportWideCC()] },
  });
  guardConnection(connection, events);
  return connection;
}
