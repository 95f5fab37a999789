/** What the page says about grants and robots' keys. */
import type { ChangedRobotKey, GrantClaims, SessionLoss } from '@farpoint/operator';
import type { Role, SignInError } from '@farpoint/protocol';
import type { GrantFault } from '../ground/access/operator-access.ts';
import type { Words } from './words.ts';

export const roleWords: Record<Role, string> = {
  watch: 'may watch',
  drive: 'may drive',
  supervise: 'may drive and supervise',
};

export const grantFaultWords: Record<GrantFault, string> = {
  'no-grant': 'This is neither a grant nor a ticket. Paste the whole line.',
  'other-key': 'This grant was made for another key than this browser’s.',
  'bad-ticket': 'This ticket is damaged. Paste the whole line, or ask for another.',
  expired: 'This grant has ended. Ask for another.',
  'too-many': 'This browser keeps no more grants. Remove one first.',
};

export const signInErrorWords: Record<SignInError, string> = {
  'not-permitted':
    'You have signed in, but nothing here is set up for you. Ask the person who issues grants.',
  cancelled: 'The sign-in was cancelled.',
  expired: 'The sign-in took longer than ten minutes. Sign in again.',
  'provider-unreachable': 'The sign-in service cannot be reached. Try again later.',
  'provider-refused': 'The sign-in service refused. Tell the person who set it up.',
  unproven:
    'The sign-in service did not prove who you are. Sign in again; if this stays, tell the person who set it up.',
  'bad-request': 'The page and the sign-in service do not fit together. Tell the person who set them up.',
  'too-many': 'There were too many sign-ins from your network. Wait a minute, then sign in again.',
  'issuer-failed': 'The service that issues grants has failed. Tell the person who set it up.',
};

/** A grant in one line. @param date writes a time, given in ms since 1970 */
export function grantWords(
  { name, role, robots, exp }: GrantClaims,
  nowS: number,
  date: (ms: number) => string,
): Words {
  const until = exp > nowS ? `until ${date(exp * 1000)}` : `ended ${date(exp * 1000)}`;
  return {
    text: `${name} ${roleWords[role]}: ${robots.join(', ')}, ${until}`,
    tone: exp > nowS ? 'neutral' : 'warning',
  };
}

/** What keeps the page from connecting until the operator does something. */
export interface Obstacle {
  title: string;
  text: string;
  keys: { known: string; shown: string } | null;
  /** Whether the operator may decide to trust the key that is shown. */
  mayTrust: boolean;
  /** Whether another grant may help. */
  needsGrant: boolean;
  /** The host where the operator can sign in for one; `null` if there is none, or if that is no help. */
  signInHost: string | null;
}

/**
 * @param detail what the robot said, or what was wrong with it
 * @param signInUrl where operators sign in for grants
 * @returns `null` if the page tries again by itself
 */
export function obstacleOf(
  loss: SessionLoss | null,
  detail: string | null,
  changed: ChangedRobotKey | null,
  signInUrl: string | null = null,
): Obstacle | null {
  const remedy = signInUrl === null ? 'Ask' : 'Sign in to get one. Or ask';
  switch (loss) {
    case 'not-granted':
      return {
        title: 'The robot does not admit you',
        text: `The robot says: ${detail ?? 'it admits only operators with a grant'}. ${remedy} the person who issues grants for one, and add it to this browser.`,
        keys: null,
        mayTrust: false,
        needsGrant: true,
        signInHost: signInUrl === null ? null : new URL(signInUrl).host,
      };
    case 'robot-key-changed':
      return {
        title: 'This may be another robot',
        text:
          changed?.byGrant === true
            ? 'It proves another key than the one in your grant. Do not drive it. Tell the person who issued the grant.'
            : 'It proves another key than the robot that this browser knows by this name. That is normal only if its computer was replaced or set up anew. Compare the new key with the one that the robot logs when it starts.',
        keys: changed === null ? null : { known: changed.known, shown: changed.shown },
        mayTrust: changed !== null && !changed.byGrant,
        needsGrant: false,
        signInHost: null,
      };
    case 'robot-unproven':
      return {
        title: 'This may be another robot',
        text: `This browser knows the robot by its key, but it did not prove it: ${detail ?? 'no proof'}. Somebody may stand between you and the robot.`,
        keys: null,
        mayTrust: false,
        needsGrant: false,
        signInHost: null,
      };
    default:
      return null;
  }
}
