/** What the page says about the state of watching, and about each camera. */
import type { WatchObstacle, WatchState } from '@farpoint/operator';
import { texts } from '../../words/language.ts';
import type { Tone, Words } from '../../words/words.ts';

const obstacleTones: Record<WatchObstacle, Tone> = {
  'relay-unreachable': 'warning',
  'no-broadcast': 'warning',
  'not-a-broadcast': 'bad',
  refused: 'bad',
  lost: 'warning',
};

/** @param name the robot's; `null` while it is not known */
export function watchWords({ phase, obstacle }: WatchState, name: string | null): Words {
  const said = texts().watch;
  const of = (state: string) => (name === null ? state : said.of(state, name));
  switch (phase) {
    case 'connecting':
      return { text: said.connecting, tone: 'neutral' };
    case 'waiting': {
      const why = obstacle ?? 'lost';
      return { text: said.obstacles[why], tone: obstacleTones[why] };
    }
    case 'opening':
      return { text: of(said.firstPictures), tone: 'neutral' };
    case 'live':
      return { text: of(said.live), tone: 'good' };
    case 'silent':
      return { text: of(said.silent), tone: 'warning' };
  }
}
