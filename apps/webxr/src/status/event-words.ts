/** The sentences of the event log that nothing else on the page says. */
import type { Alarm } from '@farpoint/operator';
import type { Severity } from '../events/event-log.ts';
import { alarmWords } from './alarm-words.ts';
import { LATCHED_TITLE } from './estop-words.ts';
import type { Tone, Words } from './tone.ts';

export const eventWords = {
  opened: { text: 'This page was opened', tone: 'neutral' },
  left: { text: 'Disconnected', tone: 'neutral' },
  silent: { text: 'Connection lost: nothing is heard of the robot', tone: 'bad' },
  back: { text: 'The robot is heard again', tone: 'good' },
  releaseAsked: { text: 'You released the emergency stop', tone: 'neutral' },
  stopOff: { text: 'The emergency stop is off', tone: 'good' },
  recordingEnded: { text: 'This session is no longer recorded', tone: 'neutral' },
} as const satisfies Record<string, Words>;

export function chosenWords(robotId: string): Words {
  return { text: `Robot chosen: ${robotId}`, tone: 'neutral' };
}

/** @param why who or what stopped the robot */
export function stoppedWords(why: string): Words {
  return { text: `${LATCHED_TITLE}: ${why}`, tone: 'bad' };
}

/** An alarm that was raised, changed its level, or is over. */
export function alarmEventWords(alarm: Alarm): Words {
  const { text, tone } = alarmWords(alarm, 0);
  return alarm.level === 'ok' ? { text: `Over: ${text}`, tone: 'good' } : { text: `Alarm: ${text}`, tone };
}

export const filterWords: Readonly<Record<Severity, string>> = {
  info: 'everything',
  warning: 'warnings and errors',
  error: 'errors',
};

export const severityTones: Readonly<Record<Severity, Tone>> = {
  info: 'neutral',
  warning: 'warning',
  error: 'bad',
};

/** Above the list of events, the newest first. */
export function eventsWords({ shown, kept, dropped }: Record<'shown' | 'kept' | 'dropped', number>): string {
  if (kept === 0) return 'Nothing has happened since it was cleared.';
  const all = `${shown === kept ? '' : `${shown} of `}${kept} ${kept === 1 ? 'event' : 'events'}, the newest first`;
  const before = dropped === 0 ? '' : `; ${dropped} older ${dropped === 1 ? 'one was' : 'ones were'} dropped`;
  return `${all}${before}. They stay in this tab until you clear them.`;
}
