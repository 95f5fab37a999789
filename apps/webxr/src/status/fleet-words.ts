/** The list of robots: what each says about itself in words, which are shown, and in which order. Pure. */
import type { RobotListing, RobotStatus } from '@farpoint/protocol';
import type { Tone } from './tone.ts';

export const FLEET_ORDERS = ['name', 'attention', 'battery'] as const;
export type FleetOrder = (typeof FLEET_ORDERS)[number];

export const fleetOrderWords: Readonly<Record<FleetOrder, string>> = {
  name: 'Name',
  attention: 'Needs attention first',
  battery: 'Lowest battery first',
};

/** Below this share, a battery is said as a warning. */
const LOW_BATTERY = 0.2;
/** From so many robots on, the list can be searched and sorted. */
export const SEARCHED_FROM = 4;

export interface StatusWord {
  readonly text: string;
  readonly tone: Tone;
}

/** A robot in the list. */
export interface ListedRobot extends RobotListing {
  /** What it says about itself, the most urgent first; `null` if it does not say. */
  readonly words: readonly StatusWord[] | null;
}

export interface FleetFacts {
  readonly robots: readonly RobotListing[];
  readonly statuses: ReadonlyMap<string, RobotStatus>;
  readonly order: FleetOrder;
  /** Part of a name or an id. */
  readonly search: string;
}

export function listedRobots({ robots, statuses, order, search }: FleetFacts): ListedRobot[] {
  const wanted = search.trim().toLowerCase();
  const matches = ({ id, name }: RobotListing) =>
    wanted === '' || id.includes(wanted) || name.toLowerCase().includes(wanted);
  const rank = ({ id }: RobotListing) => rankOf(order, statuses.get(id));
  return robots
    .filter(matches)
    .sort((a, b) => rank(a) - rank(b) || a.name.localeCompare(b.name) || a.id.localeCompare(b.id))
    .map(({ id, name }) => ({ id, name, words: wordsOf(statuses.get(id)) }));
}

/** @param shown of `all` */
export function foundWords(shown: number, all: number): string {
  return shown === all ? `${all} robots` : `${shown} of ${all} robots`;
}

/** How long ago this page has last drawn a robot. */
export function seenWords(agoMs: number): string {
  const minutes = Math.floor(agoMs / 60_000);
  if (minutes < 1) return 'seen here just now';
  return minutes < 120 ? `seen here ${minutes} min ago` : `seen here ${Math.floor(minutes / 60)} h ago`;
}

/** Small comes first. */
function rankOf(order: FleetOrder, status: RobotStatus | undefined): number {
  switch (order) {
    case 'name':
      return 0;
    case 'battery':
      return status?.battery ?? Number.MAX_VALUE;
    case 'attention':
      if (status === undefined) return 4;
      if (status.estop) return 0;
      if (status.alarms > 0) return 1;
      return (status.battery ?? 1) < LOW_BATTERY ? 2 : 3;
  }
}

function wordsOf(status: RobotStatus | undefined): StatusWord[] | null {
  if (status === undefined) return null;
  const { estop, alarms, driven, driver, moving, battery, operators, maxOperators } = status;
  const word = (text: string, tone: Tone = 'neutral') => ({ text, tone });
  return [
    ...(estop ? [word('STOP is on', 'bad')] : []),
    ...(alarms === 0 ? [] : [word(alarms === 1 ? '1 alarm' : `${alarms} alarms`, 'warning')]),
    word(driven ? (driver === undefined ? 'Somebody drives' : `${driver} drives`) : 'Nobody drives'),
    ...(moving ? [word('moving')] : []),
    ...(battery === undefined
      ? []
      : [word(`battery ${Math.round(battery * 100)} %`, battery < LOW_BATTERY ? 'warning' : 'neutral')]),
    operators >= maxOperators
      ? word(`full: ${operators} here`, 'warning')
      : word(`${operators} of ${maxOperators} here`),
  ];
}
