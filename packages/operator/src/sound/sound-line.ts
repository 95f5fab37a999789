/** The m-line for the robot's microphone and this operator's voice. */
import { SOUND_STREAM_ID } from '@farpoint/protocol';

export interface SoundLine {
  /** The robot's microphone. */
  track: MediaStreamTrack;
  /** Tells what is being played. */
  receiver: Pick<RTCRtpReceiver, 'getSynchronizationSources'>;
  /** Sends this operator's voice. */
  sender: Pick<RTCRtpSender, 'replaceTrack'>;
}

/**
 * Recognises the robot's sound. Call it synchronously in `ontrack`: it also makes the answer say that this operator may
 * speak.
 */
export function soundLineOf({ track, streams, receiver, transceiver }: RTCTrackEvent): SoundLine | null {
  if (track.kind !== 'audio' || !streams.some(({ id }) => id === SOUND_STREAM_ID)) return null;
  // Sends nothing before there is a track.
  transceiver.direction = 'sendrecv';
  return { track, receiver, sender: transceiver.sender };
}
