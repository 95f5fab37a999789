import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { type GrantedOperator, grantTo, makeIssuer } from '@farpoint/grants/testing';
import type { Role } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { shownGrant } from './shown-grant.ts';
import { type Credentials, SignaledOperator } from './signaled-operator.ts';
import { type RobotUnderTest, useRobot } from './use-robot.ts';

type Issuer = Awaited<ReturnType<typeof makeIssuer>>;

/** A robot under test that admits by grants. */
export interface GrantingRobot {
  readonly robot: RobotUnderTest;
  /** The issuer that the robot trusts. */
  readonly issuer: Issuer;
  /** The file of the keys that the robot trusts; it goes after the file's tests. */
  readonly keyFile: string;
  /** Writes whose keys the robot trusts once it reads them again. */
  trust(...issuers: Issuer[]): void;
  /** A grant of its own for a session of this person. */
  grant(name: string, role: Role): Promise<GrantedOperator>;
  /** An operator that shows the grant, closed after the test, whatever comes of it. */
  open(grant: GrantedOperator): Promise<SignaledOperator>;
  /** The same, once it has a session. */
  connect(grant: GrantedOperator): Promise<SignaledOperator>;
  /** The same two for an operator that shows what it likes. */
  openWith(credentials?: Credentials): Promise<SignaledOperator>;
  connectWith(credentials: Credentials): Promise<SignaledOperator>;
}

/**
 * Starts such a robot for a file's tests: see {@link useRobot}. Call it at the top of the file.
 *
 * @param args more of the robot's options, or what makes them from the folder
 */
export async function useGrantingRobot(
  id: string,
  args: readonly string[] | ((folder: string) => readonly string[]) = [],
): Promise<GrantingRobot> {
  const folder = useFolder();
  const keyFile = join(folder, 'grant-keys.json');
  const trust = (...issuers: Issuer[]) =>
    writeFileSync(keyFile, JSON.stringify({ keys: issuers.map(({ publicJwk }) => publicJwk) }));
  const issuer = await makeIssuer('k1');
  trust(issuer);
  const robot = useRobot(id, [
    ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--grant-keys', keyFile],
    ...(typeof args === 'function' ? args(folder) : args),
  ]);
  const openWith = async (credentials?: Credentials) =>
    robot.keep(
      await SignaledOperator.open(
        robot.stack.signalingUrl,
        id,
        credentials === undefined ? {} : { credentials },
      ),
    );
  const connectWith = async (credentials: Credentials) =>
    robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, id, { credentials }));
  let grants = 0;
  return {
    ...{ robot, issuer, keyFile, trust, openWith, connectWith },
    grant: (name, role) => grantTo(issuer, Date.now() / 1000, { name, sub: name, role, jti: `g${++grants}` }),
    open: (grant) => openWith(shownGrant(id, grant)),
    connect: (grant) => connectWith(shownGrant(id, grant)),
  };
}
