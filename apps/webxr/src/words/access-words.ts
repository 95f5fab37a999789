/** What the page says about grants and robots' keys. */
import type { ChangedRobotKey, GrantClaims, SessionLoss } from '@farpoint/operator';
import { texts } from './language.ts';
import type { Words } from './words.ts';

/** A grant in one line. @param date writes a time, given in ms since 1970 */
export function grantWords(
  { name, role, robots, exp }: GrantClaims,
  nowS: number,
  date: (ms: number) => string,
): Words {
  const said = texts().access;
  const until = exp > nowS ? said.until(date(exp * 1000)) : said.ended(date(exp * 1000));
  return {
    text: said.grant(name, said.roles[role], robots.join(', '), until),
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
  const said = texts().access;
  switch (loss) {
    case 'not-granted': {
      const remedy = signInUrl === null ? said.askForGrant : said.signInForGrant;
      return {
        title: said.notAdmitted,
        text: remedy(detail ?? said.onlyWithGrant),
        keys: null,
        mayTrust: false,
        needsGrant: true,
        signInHost: signInUrl === null ? null : new URL(signInUrl).host,
      };
    }
    case 'robot-key-changed':
      return {
        title: said.otherRobot,
        text: changed?.byGrant === true ? said.otherKeyThanGranted : said.otherKeyThanKnown,
        keys: changed === null ? null : { known: changed.known, shown: changed.shown },
        mayTrust: changed !== null && !changed.byGrant,
        needsGrant: false,
        signInHost: null,
      };
    case 'robot-unproven':
      return {
        title: said.otherRobot,
        text: said.unproven(detail ?? said.noProof),
        keys: null,
        mayTrust: false,
        needsGrant: false,
        signInHost: null,
      };
    default:
      return null;
  }
}
