/** What must be known of a robot before it is used. */
import type { RobotAbout } from '@farpoint/protocol';
import { texts } from './language.ts';
import type { Words } from './words.ts';

/** What stands above the figures for as long as it holds. */
export function aboutWords(about: RobotAbout | null): Words[] {
  if (about === null) return [];
  const said = texts().figures;
  const words: Words[] = [];
  if (about.shows === 'files') words.push({ text: said.isPlayback, tone: 'warning' });
  if (about.recorded) words.push({ text: said.isRecorded, tone: 'bad' });
  return words;
}

/** In place of who drives. */
export function withoutWheelsWords(): Words {
  return { text: texts().driving.holder.withoutWheels, tone: 'neutral' };
}
