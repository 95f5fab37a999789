/** What is said about grants, sign-ins and robots' keys. */
import type { Role, SignInError } from '@farpoint/protocol';
import type { GrantFault } from '../../ground/access/operator-access.ts';

export const access = {
  roles: {
    watch: 'may watch',
    drive: 'may drive',
    supervise: 'may drive and supervise',
  } satisfies Record<Role, string>,
  grantFaults: {
    'no-grant': 'This is neither a grant nor a ticket. Paste the whole line.',
    'other-key': 'This grant was made for another key than this browser’s.',
    'bad-ticket': 'This ticket is damaged. Paste the whole line, or ask for another.',
    expired: 'This grant has ended. Ask for another.',
    'too-many': 'This browser keeps no more grants. Remove one first.',
  } satisfies Record<GrantFault, string>,
  signInErrors: {
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
  } satisfies Record<SignInError, string>,
  until: (date: string) => `until ${date}`,
  ended: (date: string) => `ended ${date}`,
  grant: (name: string, role: string, robots: string, until: string) =>
    `${name} ${role}: ${robots}, ${until}`,
  signedIn: (name: string, role: string, robots: string) => `Signed in: ${name} ${role}: ${robots}`,
  added: 'Added.',
  addedForNow: 'Added for this visit: the browser keeps nothing for this page.',
  needsHttps: 'Grants need https: open the page at its https address.',
  noRobots: 'None yet. A robot is known after the first session with it.',
  remove: 'Remove',
  forget: 'Forget',
  notAdmitted: 'The robot does not admit you',
  onlyWithGrant: 'it admits only operators with a grant',
  /** @param detail what the robot said */
  askForGrant: (detail: string) =>
    `The robot says: ${detail}. Ask the person who issues grants for one, and add it to this browser.`,
  signInForGrant: (detail: string) =>
    `The robot says: ${detail}. Sign in to get one. Or ask the person who issues grants for one, and add it to this browser.`,
  otherRobot: 'This may be another robot',
  otherKeyThanGranted:
    'It proves another key than the one in your grant. Do not drive it. Tell the person who issued the grant.',
  otherKeyThanKnown:
    'It proves another key than the robot that this browser knows by this name. That is normal only if its computer was replaced or set up anew. Compare the new key with the one that the robot logs when it starts.',
  unproven: (detail: string) =>
    `This browser knows the robot by its key, but it did not prove it: ${detail}. Somebody may stand between you and the robot.`,
  noProof: 'no proof',
};
