/** Who is here, in words. */
import type { LeaseState, Operators } from '@farpoint/operator';
import type { Role } from '@farpoint/protocol';
import { nameWords } from './handover-words.ts';

export interface ShownPerson {
  /** The robot's number of the session. */
  number: number;
  name: string;
  text: string;
  /** Whether this operator may end the session. */
  mayEnd: boolean;
  /** Whether this operator may offer it the drive. */
  mayOffer: boolean;
}

export interface ShownPeople {
  /** `null` if the robot does not say who is here, or nobody else is and nothing proves who this is. */
  line: string | null;
  persons: ShownPerson[];
  /** Whether this operator may ask for the drive. */
  mayAsk: boolean;
}

export interface PeopleFacts {
  operators: Operators | null;
  /** What this operator's grant says; `null` without one. */
  role: Role | null;
  holder: LeaseState['holder'];
  /** Whether a request or offer of this operator waits for an answer. */
  waits: boolean;
  /** For how long the one who drives has driven, whole minutes; `null` if nobody knows. */
  drivesMinutes: number | null;
}

const activityOf: Record<Role, string> = { watch: 'watching', drive: 'may drive', supervise: 'supervisor' };

export function shownPeople({ operators, role, holder, waits, drivesMinutes }: PeopleFacts): ShownPeople {
  if (operators === null) return { line: null, persons: [], mayAsk: false };
  const { operators: listed, more = 0 } = operators;
  const total = listed.length + more;
  const driver = listed.find(({ drives }) => drives);
  const drives = driver === undefined ? '' : `: ${driver.you ? 'you drive' : `${nameWords(driver)} drives`}`;
  const isAlone = total === 1 && listed[0]?.claimed === true;
  return {
    line: isAlone ? null : `${total === 1 ? 'Only you are' : `${total} are`} here${drives}`,
    persons: listed.map((person) => {
      const { number, name, you } = person;
      return {
        ...{ number, name },
        text: `${nameWords(person)} (${activities(person, drivesMinutes).join(', ')})`,
        mayEnd: role === 'supervise' && !you,
        mayOffer: holder === 'you' && !you && person.role !== 'watch' && !waits,
      };
    }),
    mayAsk: holder === 'other' && role !== 'watch' && driver !== undefined && !waits,
  };
}

function activities(person: Operators['operators'][number], minutes: number | null): string[] {
  const { role, drives, you, away } = person;
  const since = minutes === null || minutes === 0 ? '' : ` for ${minutes} min`;
  return [
    ...(you ? ['you'] : []),
    drives ? `driving${since}` : activityOf[role],
    ...(away === true ? ['not heard from'] : []),
  ];
}
