/** Who is admitted, and what is sent to whom: faults that only show when options are combined. */
import { existsSync } from 'node:fs';
import { GrantKeysError, readJwkSet } from '@farpoint/grants';
import { isLoopbackHost } from '@farpoint/protocol';
import { readText } from './read-text.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';

export function checkAccess(
  { grantKeys, revocations, referenceSignaling, signaling, ...values }: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
): void {
  const { token, plaintextToken, estopRelease } = values;
  if (token !== null && !plaintextToken && !isPrivate(signaling))
    refuse(
      'token',
      `would be sent to ${new URL(signaling).host} in the clear: use a wss:// address, or --plaintext-token`,
    );
  if (grantKeys === null && revocations.length > 0)
    refuse('revocations', 'needs --grant-keys: without grants there is nothing to revoke');
  if (grantKeys === null && estopRelease === 'supervisor')
    refuse('estopRelease', 'needs --grant-keys for the policy supervisor: without grants nobody supervises');
  if (grantKeys === null) return;
  if (referenceSignaling !== null)
    refuse('referenceSignaling', 'cannot be combined with --grant-keys: its operators have no grants');
  // One that is not there yet will be made when somebody's grant is revoked; an empty one revokes nobody's.
  for (const path of revocations)
    if (existsSync(path)) readText(path, (detail) => refuse('revocations', detail));
  const text = readText(grantKeys, (detail) => refuse('grantKeys', detail));
  if (text === null) return;
  try {
    readJwkSet(text);
  } catch (error) {
    if (!(error instanceof GrantKeysError)) throw error;
    refuse('grantKeys', `${grantKeys} ${error.message}`);
  }
}

function isPrivate(address: string): boolean {
  const { protocol, hostname } = new URL(address);
  return protocol === 'wss:' || isLoopbackHost(hostname);
}
