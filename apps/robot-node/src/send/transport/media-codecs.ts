/** The codecs that the robot offers, and the feedback that it understands on them. */
import { CLOUD_MEDIA, SOUND_PARAMETERS, VIDEO_CLOCK_RATE, type VideoCodec } from '@farpoint/protocol';
import { RTCRtpCodecParameters, useFIR, useNACK, usePLI, useREMB, useTWCC } from 'werift';

/**
 * Constrained baseline, which every WebRTC peer decodes. The level is the one that they all accept; they decode larger
 * pictures all the same.
 */
const H264_PARAMETERS = 'profile-level-id=42e01f;packetization-mode=1;level-asymmetry-allowed=1';

/** @param withSound whether a line for sound shares them: werift tells codecs apart by their names only */
export function cloudCodecParameters(withSound = false): RTCRtpCodecParameters {
  const { mimeType, clockRate, channels } = CLOUD_MEDIA;
  // REMB for peers that support nothing better.
  const rtcpFeedback = [useTWCC(), useNACK(), useREMB()];
  const parameters = withSound ? { parameters: SOUND_PARAMETERS } : {};
  return new RTCRtpCodecParameters({ mimeType, clockRate, channels, rtcpFeedback, ...parameters });
}

export function videoCodecParameters(codec: VideoCodec): RTCRtpCodecParameters {
  return new RTCRtpCodecParameters({
    mimeType: `video/${codec}`,
    clockRate: VIDEO_CLOCK_RATE,
    rtcpFeedback: [useTWCC(), useNACK(), usePLI(), useFIR()],
    ...(codec === 'H264' ? { parameters: H264_PARAMETERS } : {}),
  });
}
