/** What the list of robots says while it is empty: nobody knows which robots there are before the service has said so. */
import type { SignalingState } from '@farpoint/operator';
import { texts } from './language.ts';
import type { Tone, Words } from './words.ts';

const tones: Record<SignalingState, Tone> = {
  ready: 'neutral',
  refused: 'bad',
  waiting: 'warning',
  connecting: 'neutral',
  stopped: 'neutral',
};

/** @param host of the signaling service, for people */
export function emptyListWords(signaling: SignalingState, host: string): Words {
  return { text: texts().link.noRobots[signaling](host), tone: tones[signaling] };
}
