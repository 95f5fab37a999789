import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { type GrantedOperator, grantTo, makeIssuer } from '@farpoint/grants/testing';
import type { Role } from '@farpoint/protocol';
import { afterAll } from 'vitest';
import { shownGrant } from './shown-grant.ts';
import { SignaledOperator } from './signaled-operator.ts';
import { useRobot } from './use-robot.ts';

/** A robot under test that admits by grants. */
export interface GrantingRobot {
  /** A grant of its own for a session of this person. */
  grant(name: string, role: Role): Promise<GrantedOperator>;
  /** An operator that shows the grant, closed after the test, whatever comes of it. */
  open(grant: GrantedOperator): Promise<SignaledOperator>;
  /** The same, once it has a session. */
  connect(grant: GrantedOperator): Promise<SignaledOperator>;
}

/** Starts such a robot for a file's tests: see {@link useRobot}. Call it at the top of the file. */
export async function useGrantingRobot(id: string, args: readonly string[] = []): Promise<GrantingRobot> {
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-granting-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  const keyFile = join(folder, 'grant-keys.json');
  const issuer = await makeIssuer('k1');
  writeFileSync(keyFile, JSON.stringify({ keys: [issuer.publicJwk] }));
  const robot = useRobot(id, [
    ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'],
    ...['--grant-keys', keyFile, ...args],
  ]);
  let grants = 0;
  const options = (grant: GrantedOperator) => ({ credentials: shownGrant(id, grant) });
  return {
    grant: (name, role) => grantTo(issuer, Date.now() / 1000, { name, sub: name, role, jti: `g${++grants}` }),
    open: async (grant) =>
      robot.keep(await SignaledOperator.open(robot.stack.signalingUrl, id, options(grant))),
    connect: async (grant) =>
      robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, id, options(grant))),
  };
}
