/** Revoked grants and a supervisor's word, with the real signaling service, its command and the running robot. */
import { execFileSync } from 'node:child_process';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { makeSigningKey, parseSigningKey } from '@farpoint/grants';
import { type GrantedOperator, grantTo } from '@farpoint/grants/testing';
import type { Operators, Role } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { shownGrant } from './testing/shown-grant.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { useRobot } from './testing/use-robot.ts';

const ROBOT = 'sim-1';
const folder = useFolder();
const at = (name: string) => join(folder, name);

/** An issuer whose private key is in a file. */
async function issuerIn(file: string) {
  const { secretJwk, publicJwk } = await makeSigningKey();
  writeFileSync(file, JSON.stringify(secretJwk));
  return { signingKey: await parseSigningKey(JSON.stringify(secretJwk)), publicJwk };
}
const issuer = await issuerIn(at('key.json'));
const partner = await issuerIn(at('partner-key.json'));
const keys = [issuer.publicJwk, partner.publicJwk];
writeFileSync(at('grant-keys.json'), JSON.stringify({ keys }));

const robot = useRobot(
  ROBOT,
  [
    ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--max-operators', '8'],
    ...['--grant-keys', at('grant-keys.json'), '--revocations', at('own.jws')],
  ],
  ['--revocations', at('sent.jws')],
);

/** As people do it. */
function revoke(list: string, key: string, ...what: string[]): void {
  const program = join(import.meta.dirname, '../../signaling/src/main.ts');
  const args = ['grant', 'revoke', '--list', at(list), '--key', at(key), ...what];
  execFileSync(process.execPath, [program, ...args], { encoding: 'utf8' });
}

let grants = 0;
const granted = (name: string, role: Role = 'drive', by = issuer, aheadS = 0) =>
  grantTo(by, Date.now() / 1000 + aheadS, { name, sub: name, role, jti: `g${++grants}` });
const open = async (grant: GrantedOperator) =>
  robot.keep(
    await SignaledOperator.open(robot.stack.signalingUrl, ROBOT, { credentials: shownGrant(ROBOT, grant) }),
  );
const connect = async (grant: GrantedOperator) =>
  robot.keep(
    await SignaledOperator.connect(robot.stack.signalingUrl, ROBOT, {
      credentials: shownGrant(ROBOT, grant),
    }),
  );

async function closedFor(operator: SignaledOperator) {
  await operator.until(({ type }) => type === 'session.closed');
  const [closed] = operator.heard.filter((message) => message.type === 'session.closed');
  return closed;
}
const refusedAs = async (grant: GrantedOperator) => closedFor(await open(grant));
const metric = (name: string) => metricOf(robot.stack.robotAdminUrl(ROBOT), `farpoint_robot_${name}`);
const REVOKED = { reason: 'not-granted', detail: 'the grant has been revoked' };

type Client = SignaledOperator['client'];
const listedBy = ({ session }: Client) => {
  const list = session.findLast((message): message is Operators => message.type === 'operators');
  return list?.operators ?? [];
};
const numberOf = (client: Client, name: string) =>
  listedBy(client).find((each) => each.name === name)?.number ?? 0;

describe('revoked grants', { timeout: 60_000 }, () => {
  it('end a moving driver’s session, stop the robot, and are refused from then on', async () => {
    const [ada, wim] = [await granted('Ada'), await granted('Wim', 'watch')];
    const counts = async () => [
      await metric('refused_total{what="grant",reason="grant-revoked"}'),
      await metric('sessions_ended_total{reason="grant-revoked"}'),
    ];
    const before = await counts();
    const [driver, watcher] = [await connect(ada), await connect(wim)];
    const lease = await driver.client.takeLease();
    const timer = setInterval(() => driver.client.drive(lease, 0.1), 20);
    try {
      await driver.client.until(() => driver.client.telemetry?.drive === 'driving');
      revoke('sent.jws', 'key.json', '--subject', 'Ada');
      expect(await closedFor(driver)).toMatchObject({ reason: 'grant-revoked' });
    } finally {
      clearInterval(timer);
    }
    await watcher.client.until(() => {
      const { session, telemetry } = watcher.client;
      const last = session.findLast(({ type }) => type === 'lease');
      return last?.type === 'lease' && last.holder === 'nobody' && telemetry?.drive !== 'driving';
    });
    expect(await refusedAs(ada)).toMatchObject(REVOKED);
    expect(await counts()).toEqual(before.map((count) => count + 1));
    // The person is welcome again with a grant of a later time.
    const { client } = await connect(await granted('Ada', 'drive', issuer, 2));
    expect((await client.message('welcome')).access?.name).toBe('Ada');
    const { length } = watcher.client.completeFrames;
    await watcher.client.until(() => watcher.client.completeFrames.length > length);
  });

  it('are those of the list’s own key: another issuer revokes nothing, whoever sends its list', async () => {
    const [ada, theirs] = [await granted('Grace'), await granted('Grace', 'drive', partner)];
    const [kept, ended] = [await connect(ada), await connect(theirs)];
    // By the robot's own file, which did not exist until now.
    revoke('own.jws', 'partner-key.json', '--subject', 'Grace');
    expect(await closedFor(ended)).toMatchObject({ reason: 'grant-revoked' });
    const { length } = kept.client.completeFrames;
    await kept.client.until(() => kept.client.completeFrames.length > length + 5);
    expect(kept.heard.some(({ type }) => type === 'session.closed')).toBe(false);
  });
});

const end = ({ client }: SignaledOperator, name: string, block = false) =>
  client.sendSession({ type: 'endSession', operator: numberOf(client, name), block });

describe('who is here', { timeout: 60_000 }, () => {
  it('who was revoked, or blocked by a supervisor, stays so when robot and service start again and nobody sends the list', async () => {
    const [grantOfRob, ray, eve] = [
      await granted('Rob'),
      await granted('Ray', 'supervise'),
      await granted('Eve'),
    ];
    const [rob, supervisor, revoked] = [await connect(grantOfRob), await connect(ray), await connect(eve)];
    revoke('sent.jws', 'key.json', `--id=${eve.claims.jti}`);
    expect(await closedFor(revoked)).toMatchObject({ reason: 'grant-revoked' });
    await supervisor.client.until(() => numberOf(supervisor.client, 'Rob') > 0);
    end(supervisor, 'Rob', true);
    expect(await closedFor(rob)).toMatchObject({ detail: 'Ray ended the session and blocked the grant' });
    const blocked = { reason: 'not-granted', detail: 'a supervisor of this robot has blocked the grant' };
    expect(await refusedAs(grantOfRob)).toMatchObject(blocked);
    const list = readFileSync(at('sent.jws'));
    rmSync(at('sent.jws'));
    await robot.stack.signaling.stop();
    await robot.stack.startSignaling();
    await robot.stack.robot(ROBOT).stop();
    await robot.stack.restartRobot(ROBOT);
    expect(await refusedAs(eve)).toMatchObject(REVOKED);
    expect(await refusedAs(grantOfRob)).toMatchObject(blocked);
    await connect(await granted('Rob'));
    writeFileSync(at('sent.jws'), list);
  });
});
