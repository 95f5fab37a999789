/** What must be known of a robot before it is used. */
import type { RobotAbout } from '@farpoint/protocol';
import type { Words } from './words.ts';

/** What stands above the figures for as long as it holds. */
export function aboutWords(about: RobotAbout | null): Words[] {
  if (about === null) return [];
  const words: Words[] = [];
  if (about.shows === 'files')
    words.push({ text: 'Playback: nothing that you see is there now', tone: 'warning' });
  if (about.recorded) words.push({ text: 'This session is being recorded', tone: 'bad' });
  return words;
}

/** In place of who drives. */
export const withoutWheelsWords: Words = {
  text: 'Nothing to drive: this robot has no wheels',
  tone: 'neutral',
};
