/** The texts about the robot's sound and the operator's voice. */
import type { MicrophoneState, Sound, VoiceStatus } from '@farpoint/operator';
import { texts } from './language.ts';
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

const MICROPHONE_STATES: Record<Exclude<MicrophoneState, 'live' | 'failed'>, Omit<SoundWords, 'text'>> = {
  off: { state: 'waiting', tone: 'neutral' },
  starting: { state: 'waiting', tone: 'neutral' },
  muted: { state: 'waiting', tone: 'neutral' },
  'slow-link': { state: 'failed', tone: 'warning' },
};

/** What is heard of the robot. */
export function heardWords({ wanted, microphone, playing, refused }: HeardFacts): SoundWords {
  const said = texts().media.heard;
  if (!wanted) return { state: 'off', text: said.off, tone: 'neutral' };
  if (microphone === undefined) return { state: 'waiting', text: said.waitingForRobot, tone: 'neutral' };
  const { state, detail } = microphone;
  if (state === 'failed')
    return { state: 'failed', text: said.noSound(detail ?? said.microphoneFailed), tone: 'warning' };
  if (state !== 'live') return { ...MICROPHONE_STATES[state], text: said.microphone[state] };
  if (refused) return { state: 'failed', text: said.refused, tone: 'warning' };
  if (!playing) return { state: 'waiting', text: said.waitingForSound, tone: 'neutral' };
  return { state: 'live', text: said.live, tone: 'good' };
}

/** Whether the robot hears the operator. */
export function voiceWords({ held, sending, failure }: VoiceStatus, voice: Sound['voice']): SoundWords {
  const { voice: said, voiceFailures } = texts().media;
  if (!held) return { state: 'off', text: '', tone: 'neutral' };
  if (failure !== null) return { state: 'failed', text: voiceFailures[failure.reason], tone: 'warning' };
  if (!sending) return { state: 'waiting', text: said.opening, tone: 'neutral' };
  switch (voice?.state) {
    case 'open':
      return { state: 'live', text: said.heard, tone: 'good' };
    case 'not-driving':
      return { state: 'failed', text: said.onlyDriver, tone: 'warning' };
    case 'failed':
      return { state: 'failed', text: said.failed(voice.detail ?? said.loudspeakerFailed), tone: 'warning' };
    case 'silent':
      return { state: 'waiting', text: said.silent, tone: 'warning' };
    default:
      return { state: 'waiting', text: said.waiting, tone: 'neutral' };
  }
}
