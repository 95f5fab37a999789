/** The list of robots: what each tells about itself in words, which are shown, and in which order. Pure. */
import type { RobotListing, RobotStatus } from '@farpoint/protocol';
import { texts } from './language.ts';
import type { Tone, Words } from './words.ts';

/** Below this share, a battery is a warning. Chosen: a fifth is enough to drive back. fleet-words.test.ts holds it. */
const LOW_BATTERY = 0.2;
/** From so many robots on, the list has a search field. Chosen: more do not fit a phone. fleet-words.test.ts holds it. */
const SEARCHED_FROM = 7;
const [MINUTE_MS, HOUR_MS, DAY_MS] = [60_000, 3_600_000, 86_400_000];

/** A robot in the list. */
export interface ListedRobot extends RobotListing {
  /** What it tells about itself, the most urgent first; empty if it does not. */
  readonly words: readonly Words[];
  /** `null` if it does not tell. */
  readonly version: string | null;
}

export interface FleetFacts {
  readonly robots: readonly RobotListing[];
  readonly statuses: ReadonlyMap<string, RobotStatus>;
  /** Part of a name or an id. */
  readonly search: string;
  /** The time of day, ms. */
  readonly unixMs: number;
}

/** Those that match, by name. */
export function listedRobots({ robots, statuses, search, unixMs }: FleetFacts): ListedRobot[] {
  const wanted = search.trim().toLowerCase();
  return robots
    .filter(({ id, name }) => id.includes(wanted) || name.toLowerCase().includes(wanted))
    .sort((a, b) => byName.compare(a.name, b.name) || byName.compare(a.id, b.id))
    .map(({ id, name }) => {
      const status = statuses.get(id);
      const words = status === undefined ? [] : wordsOf(status, unixMs);
      return { id, name, words, version: status?.version ?? null };
    });
}

/** “Robot 10” comes after “Robot 9”. */
const byName = new Intl.Collator(undefined, { numeric: true, sensitivity: 'base' });

/** @param all robots in the list */
export function isSearched(all: number): boolean {
  return all >= SEARCHED_FROM;
}

/** How long ago this browser has drawn a robot last. */
export function seenWords(agoMs: number): string {
  const { seen } = texts().fleet;
  if (agoMs < MINUTE_MS) return seen.justNow;
  const minutes = Math.floor(agoMs / MINUTE_MS);
  return minutes < 120 ? seen.minutes(minutes) : seen.hours(Math.floor(agoMs / HOUR_MS));
}

function wordsOf(status: RobotStatus, unixMs: number): Words[] {
  const said = texts().fleet;
  const { alarms, battery, operators, maxOperators, watchers } = status;
  const word = (text: string, tone: Tone = 'neutral'): Words => ({ text, tone });
  return [
    stateWords(status, unixMs),
    ...(alarms === 0 ? [] : [word(said.alarms(alarms), 'warning')]),
    ...(battery === undefined
      ? []
      : [word(said.battery(Math.round(battery * 100)), battery < LOW_BATTERY ? 'warning' : 'neutral')]),
    operators >= maxOperators
      ? word(said.full(operators), 'warning')
      : word(said.operators(operators, maxOperators)),
    ...(watchers === 0 ? [] : [word(said.watching(watchers))]),
  ];
}

const toneOf: Readonly<Record<RobotStatus['state'], Tone>> = {
  free: 'good',
  driven: 'neutral',
  stopped: 'bad',
  fault: 'bad',
};

function stateWords({ state, sinceMs, driver }: RobotStatus, unixMs: number): Words {
  const said = texts().fleet;
  const since = sinceText(sinceMs, unixMs);
  const text =
    state === 'driven' && driver !== undefined ? said.drives(driver, since) : said.state[state](since);
  return { text, tone: toneOf[state] };
}

/** The time of day, or the date if that is longer ago than a day. By the robot's clock. */
function sinceText(sinceMs: number, unixMs: number): string {
  const date = new Date(sinceMs);
  return unixMs - sinceMs < DAY_MS
    ? date.toLocaleTimeString(undefined, { hour: '2-digit', minute: '2-digit' })
    : date.toLocaleDateString();
}
