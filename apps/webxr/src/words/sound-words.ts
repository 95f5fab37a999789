/** The texts about the robot's sound and the operator's voice. */
import type { MicrophoneState, Sound, VoiceFailureReason, VoiceStatus } from '@farpoint/operator';
import type { Words } from './words.ts';

/** In a word what it is like, and in a sentence why. */
export interface SoundWords extends Words {
  readonly state: 'off' | 'waiting' | 'live' | 'failed';
}

export interface HeardFacts {
  /** Whether the operator wants to hear the robot. */
  readonly wanted: boolean;
  readonly microphone: Sound['microphone'];
  /** Whether the browser plays something. */
  readonly playing: boolean;
  /** Whether the browser did not play when it was told to. */
  readonly refused: boolean;
}

const MICROPHONE_WORDS: Record<Exclude<MicrophoneState, 'live' | 'failed'>, SoundWords> = {
  off: { state: 'waiting', text: 'Waiting for the robot…', tone: 'neutral' },
  starting: { state: 'waiting', text: 'The microphone starts…', tone: 'neutral' },
  muted: { state: 'waiting', text: 'Muted while you speak', tone: 'neutral' },
  'slow-link': { state: 'failed', text: 'Off: the connection is too slow for sound', tone: 'warning' },
};

/** What is heard of the robot. */
export function heardWords({ wanted, microphone, playing, refused }: HeardFacts): SoundWords {
  if (!wanted) return { state: 'off', text: 'Off', tone: 'neutral' };
  if (microphone === undefined) return { state: 'waiting', text: 'Waiting for the robot…', tone: 'neutral' };
  const { state, detail } = microphone;
  if (state === 'failed')
    return { state: 'failed', text: `No sound: ${detail ?? 'the microphone has failed'}`, tone: 'warning' };
  if (state !== 'live') return MICROPHONE_WORDS[state];
  if (refused)
    return { state: 'failed', text: 'The browser did not play it: press Sound twice', tone: 'warning' };
  if (!playing) return { state: 'waiting', text: 'Waiting for sound…', tone: 'neutral' };
  return { state: 'live', text: 'Live', tone: 'good' };
}

/** Why the operator's microphone cannot be used. */
export const voiceFailureWords: Record<VoiceFailureReason, string> = {
  refused: 'The browser does not let this page use the microphone. Allow it in the address bar to speak.',
  'no-microphone': 'No microphone was found. Connect one to speak.',
  'in-use': 'The microphone is in use by another program.',
  insecure: 'To speak, open the page at its https address.',
  failed: 'The microphone could not be opened.',
};

/** Whether the robot hears the operator. */
export function voiceWords({ held, sending, failure }: VoiceStatus, voice: Sound['voice']): SoundWords {
  if (!held) return { state: 'off', text: '', tone: 'neutral' };
  if (failure !== null) return { state: 'failed', text: voiceFailureWords[failure.reason], tone: 'warning' };
  if (!sending) return { state: 'waiting', text: 'Opening your microphone…', tone: 'neutral' };
  switch (voice?.state) {
    case 'open':
      return { state: 'live', text: 'The robot hears you', tone: 'good' };
    case 'not-driving':
      return { state: 'failed', text: 'Not heard: only the driver can speak', tone: 'warning' };
    case 'failed':
      return {
        state: 'failed',
        text: `Not heard: ${voice.detail ?? 'the loudspeaker has failed'}`,
        tone: 'warning',
      };
    case 'silent':
      return { state: 'waiting', text: 'Not heard: your voice does not arrive', tone: 'warning' };
    default:
      return { state: 'waiting', text: 'Waiting for the robot…', tone: 'neutral' };
  }
}
