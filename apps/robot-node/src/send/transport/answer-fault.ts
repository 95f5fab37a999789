const CLOUD_REFUSED = 'the cloud is refused (m=audio has port 0)';
const CHANNELS_REFUSED = 'the data channels are refused (m=application has port 0)';
const ATTRIBUTES = ['ice-ufrag', 'ice-pwd', 'fingerprint'] as const;

/**
 * Finds faults of an SDP answer before it is used. werift accepts texts that can never connect, and the operator
 * would only learn of it by a timeout.
 *
 * @param videoLines number of video m-lines in the offer
 * @param soundLine whether the offer has an m-line for sound
 * @returns the fault, for people; `null` if there is none
 */
export function answerFault(sdp: string, videoLines: number, soundLine = false): string | null {
  // An answer repeats the offer's m-lines in order (RFC 3264 §6).
  const videos = Array.from({ length: videoLines }, () => 'video');
  const sections = ['audio', ...videos, ...(soundLine ? ['audio'] : []), 'application'];
  const lines = sdp.split(/\r?\n/);
  if (lines[0] !== 'v=0') return 'no SDP: it does not begin with v=0';
  const media = lines.filter((line) => line.startsWith('m=')).map((line) => line.slice(2).split(' '));
  if (media.length !== sections.length)
    return `${media.length} m-lines, where the offer has ${sections.length}`;
  for (const [index, kind] of sections.entries()) {
    const [found, port] = media[index] as string[];
    if (found !== kind) return `m-line ${index + 1} is ${found?.slice(0, 20)}, where the offer has ${kind}`;
    // Without video and sound, an operator still sees clouds.
    if (port === '0' && index === 0) return CLOUD_REFUSED;
    if (port === '0' && kind === 'application') return CHANNELS_REFUSED;
  }
  const missing = ATTRIBUTES.find((name) => !lines.some((line) => line.startsWith(`a=${name}:`)));
  return missing === undefined ? null : `no a=${missing}`;
}
