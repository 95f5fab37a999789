/** Who is here, in words. */
import type { LeaseState, Operators } from '@farpoint/operator';
import type { Role } from '@farpoint/protocol';
import { nameWords } from './handover-words.ts';

export interface ShownPerson {
  /** The robot's number of the session. */
  number: number;
  /** As it is shown: in quotation marks if nothing proves it. */
  name: string;
  text: string;
  /** Whether this operator may end the session. */
  mayEnd: boolean;
  /** Whether this operator may offer it the drive now. */
  mayOffer: boolean;
}

export interface ShownPeople {
  /** `null` if the robot does not say who is here, or nobody else is and nothing proves who this is. */
  line: string | null;
  persons: ShownPerson[];
  /** Whether this operator may ask for the drive now. */
  mayAsk: boolean;
  /** Whether anybody else is here to whom this operator could hand the drive. */
  hasHeirs: boolean;
}

export interface PeopleFacts {
  operators: Operators | null;
  /** What this operator's grant says; `null` without one. */
  role: Role | null;
  holder: LeaseState['holder'];
  /** Whether a request or offer of this operator waits for an answer. */
  waits: boolean;
  /** Whether the emergency stop is on: then nothing is asked or offered. */
  stopped: boolean;
  /** For how long the one who drives has driven, whole minutes; `null` if nobody knows. */
  drivesMinutes: number | null;
}

type Person = Operators['operators'][number];

const activityOf: Record<Role, string> = { watch: 'watching', drive: 'may drive', supervise: 'supervisor' };

export function shownPeople(facts: PeopleFacts): ShownPeople {
  const { operators, role, holder, drivesMinutes } = facts;
  if (operators === null) return { line: null, persons: [], mayAsk: false, hasHeirs: false };
  const { operators: listed, more = 0 } = operators;
  const total = listed.length + more;
  const driver = listed.find(({ drives }) => drives);
  const drives = driver === undefined ? '' : `: ${driver.you ? 'you drive' : `${nameWords(driver)} drives`}`;
  const isAlone = total === 1 && listed[0]?.claimed === true;
  const isFree = !facts.waits && !facts.stopped;
  return {
    line: isAlone ? null : `${total === 1 ? 'Only you are' : `${total} are`} here${drives}`,
    persons: listed.map((person) => ({
      number: person.number,
      name: nameWords(person),
      text: `${nameWords(person)} (${activities(person, drivesMinutes).join(', ')})`,
      mayEnd: role === 'supervise' && !person.you,
      mayOffer: holder === 'you' && isFree && isHeir(person),
    })),
    mayAsk: holder === 'other' && role !== 'watch' && driver !== undefined && isFree,
    hasHeirs: listed.some(isHeir),
  };
}

function isHeir({ you, role }: Person): boolean {
  return !you && role !== 'watch';
}

function activities({ role, drives, you, away }: Person, minutes: number | null): string[] {
  const all = [drives ? `driving${sinceWords(minutes)}` : activityOf[role]];
  if (you) all.unshift('you');
  if (away === true) all.push('away: not heard from');
  return all;
}

function sinceWords(minutes: number | null): string {
  if (minutes === null) return '';
  if (minutes < 1) return ' for less than 1 min';
  const hours = Math.floor(minutes / 60);
  return ` for ${hours === 0 ? '' : `${hours} h `}${minutes % 60} min`;
}
