/** Who is here, in words. */
import type { LeaseState, Operators } from '@farpoint/operator';
import type { Role } from '@farpoint/protocol';
import { nameWords } from './handover-words.ts';
import { texts } from './language.ts';

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

export function shownPeople(facts: PeopleFacts): ShownPeople {
  const { operators, role, holder, drivesMinutes } = facts;
  if (operators === null) return { line: null, persons: [], mayAsk: false, hasHeirs: false };
  const { operators: listed, more = 0 } = operators;
  const total = listed.length + more;
  const driver = listed.find(({ drives }) => drives);
  const isAlone = total === 1 && listed[0]?.claimed === true;
  const isFree = !facts.waits && !facts.stopped;
  return {
    line: isAlone ? null : lineOf(total, driver),
    persons: listed.map((person) => ({
      number: person.number,
      name: nameWords(person),
      text: texts().people.person(nameWords(person), activities(person, drivesMinutes)),
      mayEnd: role === 'supervise' && !person.you,
      mayOffer: holder === 'you' && isFree && isHeir(person),
    })),
    mayAsk: holder === 'other' && role !== 'watch' && driver !== undefined && isFree,
    hasHeirs: listed.some(isHeir),
  };
}

function lineOf(total: number, driver: Person | undefined): string {
  const said = texts().people;
  const count = total === 1 ? said.onlyYou : said.count(total);
  if (driver === undefined) return count;
  return driver.you ? said.andYouDrive(count) : said.andDrives(count, nameWords(driver));
}

function isHeir({ you, role }: Person): boolean {
  return !you && role !== 'watch';
}

function activities({ role, drives, you, away }: Person, minutes: number | null): string[] {
  const said = texts().people;
  const all = [drives ? drivingWords(minutes) : said.activities[role]];
  if (you) all.unshift(said.you);
  if (away === true) all.push(said.away);
  return all;
}

function drivingWords(minutes: number | null): string {
  const said = texts().people;
  if (minutes === null) return said.driving;
  return minutes < 1 ? said.drivingBriefly : said.drivingFor(Math.floor(minutes / 60), minutes % 60);
}
