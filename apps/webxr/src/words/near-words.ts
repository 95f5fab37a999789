/** What is near the robot, for people: metres from its edge, and the direction. */
import { type NearHit, nearestHits, unseenDirections } from '../ground/near-field/directions.ts';
import type { NearView } from '../ground/near-field/near-view.ts';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';
import type { Tone, Words } from './words.ts';

/**
 * Nearer than this is very near, and near, metres. Chosen: about half an arm's length and a step
 * (docs/awareness.md).
 */
export const VERY_NEAR_M = 0.35;
export const NEAR_M = 1;
const ALL_AROUND = 'ahead,left,behind,right';

/** What is nearest; or that nothing is known. */
export function nearWords(view: NearView | null): Words {
  const said = texts().motion.near;
  if (view === null) return { text: said.noData, tone: 'warning' };
  const [nearest] = nearestHits(view.sectors);
  const text = nearest === undefined ? said.nothing : hitText(nearest);
  if (view.stale)
    return { text: said.old(fixed(view.ageMs / 1000, view.ageMs < 1000 ? 1 : 0), text), tone: 'warning' };
  return { text: capitalised(text), tone: nearest === undefined ? 'neutral' : toneOf(nearest) };
}

/** What else is near in other directions, and where nothing is seen; empty if there is nothing to say. */
export function nearDetails(view: NearView | null): string {
  if (view === null) return '';
  const others = nearestHits(view.sectors)
    .slice(1)
    .filter(({ metres }) => metres < NEAR_M)
    .slice(0, 2)
    .map(hitText);
  const said = texts().motion.near;
  const unseen = unseenDirections(view.sectors);
  const hidden =
    unseen.length === 0
      ? []
      : [
          unseen.join() === ALL_AROUND
            ? said.unseenAllAround
            : said.unseen(unseen.map((direction) => said.directions[direction])),
        ];
  return [...others, ...hidden].join(' · ');
}

function hitText({ kind, metres, direction }: NearHit): string {
  const said = texts().motion.near;
  const there = said.directions[direction];
  const where = metres < 0.05 ? said.atEdge(there) : said.at(fixed(metres, 1), there);
  return kind === 'drop' ? said.drop(where) : where;
}

function toneOf({ kind, metres }: NearHit): Tone {
  if (metres < VERY_NEAR_M) return 'bad';
  return metres < NEAR_M || kind === 'drop' ? 'warning' : 'neutral';
}

function capitalised(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
