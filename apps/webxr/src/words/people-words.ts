/** Who is here, in words. */
import type { Operators } from '@farpoint/operator';
import type { Role } from '@farpoint/protocol';

export interface ShownPerson {
  /** The robot's number of the session. */
  number: number;
  name: string;
  text: string;
  /** Whether this operator may end the session. */
  mayEnd: boolean;
}

export interface ShownPeople {
  /** `null` if the robot does not say who is here. */
  line: string | null;
  persons: ShownPerson[];
}

const activityOf: Record<Role, string> = { watch: 'watching', drive: 'may drive', supervise: 'supervisor' };

/** @param supervises whether this operator's grant lets it end the sessions of others */
export function shownPeople(operators: Operators | null, supervises: boolean): ShownPeople {
  if (operators === null) return { line: null, persons: [] };
  const { operators: listed, more = 0 } = operators;
  const total = listed.length + more;
  const driver = listed.find(({ drives }) => drives);
  const drives = driver === undefined ? '' : `: ${driver.you ? 'you drive' : `${driver.name} drives`}`;
  return {
    line: `${total === 1 ? 'Only you are' : `${total} are`} here${drives}`,
    persons: listed.map(({ number, name, role, drives, you }) => ({
      number,
      name,
      text: `${name} (${[you ? 'you' : null, drives ? 'driving' : activityOf[role]].filter((each) => each !== null).join(', ')})`,
      mayEnd: supervises && !you,
    })),
  };
}
