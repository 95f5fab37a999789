/** What {@link Voice} needs of a microphone. */
export interface VoiceMicrophone {
  readonly track: MediaStreamTrack;
  /** Gives it back to the system. */
  stop(): void;
}

/**
 * Asks the browser for the operator's microphone; the first time, the browser asks the operator.
 *
 * @throws what the browser gives instead
 */
export async function openMicrophone(): Promise<VoiceMicrophone> {
  const { mediaDevices } = navigator as Partial<Navigator>;
  if (mediaDevices === undefined) throw new InsecureError('microphones need a page loaded by HTTPS');
  const stream = await mediaDevices.getUserMedia({
    audio: { echoCancellation: true, noiseSuppression: true, autoGainControl: true, channelCount: 1 },
  });
  const [track] = stream.getAudioTracks();
  if (track === undefined) throw new DOMException('a stream without sound', 'NotFoundError');
  return {
    track,
    stop: () => {
      for (const each of stream.getTracks()) each.stop();
    },
  };
}

/** Browsers offer no microphone to pages that were not loaded by HTTPS. */
export class InsecureError extends Error {
  override readonly name = 'InsecureError';
}
