import type { FanOutOptions } from '../session/frame-fan-out.ts';
import type { SessionRecording } from './session-recording.ts';

/** What a recording has to do with the first sensor's clouds. */
export function recordedClouds(
  recording: SessionRecording | null,
): Pick<FanOutOptions, 'onFrame' | 'wantedAnyway' | 'coloursWanted'> {
  return {
    onFrame: (frame) => recording?.frame(frame),
    wantedAnyway: () => recording?.wantsClouds === true,
    coloursWanted: () => recording?.takesSentClouds === true,
  };
}
