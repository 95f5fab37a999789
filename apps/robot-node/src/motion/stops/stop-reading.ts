import { READING_LIMITS } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { RobotStop, RobotStopState } from '@farpoint/safety';

/** For people. */
export const stopWords: Readonly<Record<RobotStopState, string>> = {
  go: 'released',
  pressed: 'pressed',
  unheard: 'has said nothing yet',
  silent: 'says nothing any more',
  lost: 'cannot be read',
  settling: 'released a moment ago',
};

const labels: Readonly<Record<RobotStop, string>> = {
  topic: 'Stop (topic)',
  shm: 'Stop (shared memory)',
  gpio: 'Stop (GPIO)',
  key: 'Stop (console)',
};

/** Whether a stop in this state works: it says what it should, be it go or stop. */
export function isWell(state: RobotStopState): boolean {
  return state === 'go' || state === 'pressed' || state === 'settling';
}

/** What people should know about a stop at the robot. */
export function stopReading(stop: RobotStop, name: string, state: RobotStopState): TopicReading {
  const level = state === 'go' ? 'ok' : isWell(state) ? 'warn' : 'error';
  const words = stopWords[state];
  const text = `${name}: ${words}`;
  const fits = text.length <= READING_LIMITS.text;
  return { topic: `stop:${stop}`, label: labels[stop], level, values: [['', fits ? text : words]] };
}
