/** What the page says about the state of watching. */
import type { WatchObstacle, WatchState } from '@farpoint/operator';
import type { Words } from '../../words/words.ts';

const obstacleWords: Record<WatchObstacle, Words> = {
  'relay-unreachable': { text: 'Janus cannot be reached. Trying again…', tone: 'warning' },
  'no-broadcast': { text: 'The robot is not broadcasting. Waiting for it…', tone: 'warning' },
  'not-a-broadcast': { text: 'This mountpoint is not a robot’s broadcast. Trying again…', tone: 'bad' },
  refused: { text: 'Janus refuses: check the PIN. Trying again…', tone: 'bad' },
  lost: { text: 'The connection is lost. Trying again…', tone: 'warning' },
};

/** @param name the robot's; `null` while it is not known */
export function watchWords({ phase, obstacle }: WatchState, name: string | null): Words {
  const of = name === null ? '' : ` · ${name}`;
  switch (phase) {
    case 'connecting':
      return { text: 'Connecting…', tone: 'neutral' };
    case 'waiting':
      return obstacleWords[obstacle ?? 'lost'];
    case 'opening':
      return { text: `Waiting for the first pictures…${of}`, tone: 'neutral' };
    case 'live':
      return { text: `Live${of}`, tone: 'good' };
    case 'silent':
      return { text: `Not live: nothing arrives${of}`, tone: 'warning' };
  }
}
