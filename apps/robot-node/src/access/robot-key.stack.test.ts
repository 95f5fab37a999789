/** Operators recognise the robot: by its key file, and at the running robot behind the real signaling service. */
import { chmodSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { soleFingerprint, verifyIdentity } from '@farpoint/grants';
import { silentLogger } from '@farpoint/service';
import { afterAll, describe, expect, it, vi } from 'vitest';
import { SignaledOperator } from '../testing/signaled-operator.ts';
import { useRobot } from '../testing/use-robot.ts';
import { openRobotKey, RobotKey, RobotKeyError } from './robot-key-file.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-robot-key-'));
afterAll(() => rmSync(folder, { recursive: true }));

describe('the key file', () => {
  it('is made once, for nobody else to read, and is the robot’s from then on', async () => {
    const path = join(folder, 'state', 'rover.key.json');
    const made = await RobotKey.open(path);
    expect(made.thumbprint).toMatch(/^[\w-]{43}$/);
    expect(statSync(path).mode & 0o777).toBe(0o600);
    chmodSync(path, 0o644);
    expect((await RobotKey.open(path)).thumbprint).toBe(made.thumbprint);
    expect(statSync(path).mode & 0o777).toBe(0o600);
  });

  it('is never replaced if it cannot be used: the robot goes on without, and says so', async () => {
    const path = join(folder, 'broken.json');
    for (const text of ['', '{}', 'null', '{"kty":"EC","crv":"P-256","x":"a","y":"b","d":"c"}']) {
      writeFileSync(path, text);
      await expect(RobotKey.open(path)).rejects.toThrow(RobotKeyError);
      expect(readFileSync(path, 'utf8')).toBe(text);
    }
    const error = vi.fn();
    const log = { ...silentLogger(), error } as unknown as ReturnType<typeof silentLogger>;
    expect(await openRobotKey(path, log)).toBeNull();
    expect(await openRobotKey(join(path, 'not-a-folder', 'x'), log)).toBeNull();
    expect(error).toHaveBeenCalledTimes(2);
  });

  it('signs nothing for an offer without a certificate', async () => {
    const key = await RobotKey.open(join(folder, 'other.json'));
    expect(await key.identify({ robot: 'r1', session: 's', offer: 'v=0\r\n' }, 0)).toBeUndefined();
  });
});

const ROBOT = 'sim-1';
const path = join(folder, 'sim-1.json');
const robot = useRobot(ROBOT, [
  ...['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600', '--robot-key', path],
]);

describe('the running robot', { timeout: 30_000 }, () => {
  /** The thumbprint that the robot proves in a new session. */
  async function shown(): Promise<string> {
    const operator = robot.keep(await SignaledOperator.connect(robot.stack.signalingUrl, ROBOT));
    const offers = operator.heard.filter((message) => message.type === 'session.offer');
    const [{ sdp, identity = '' } = { sdp: '' }] = offers;
    const robotFingerprint = soleFingerprint(sdp) ?? '';
    return await verifyIdentity(identity, { robot: ROBOT, session: operator.session, robotFingerprint });
  }

  it('proves its key with the first offer of each session, also after a restart', async () => {
    const { thumbprint } = await RobotKey.open(path);
    expect(await shown()).toBe(thumbprint);
    expect(await shown()).toBe(thumbprint);
    await robot.stack.robot(ROBOT).stop();
    await robot.stack.restartRobot(ROBOT);
    expect(await shown()).toBe(thumbprint);
  });
});
