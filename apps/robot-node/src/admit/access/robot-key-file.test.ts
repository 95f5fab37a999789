/** The robot's key file. That the running robot proves its key: robot.stack.test.ts. */
import { chmodSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { silentLogger } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it, vi } from 'vitest';
import { openRobotKey, RobotKey, RobotKeyError } from './robot-key-file.ts';

const folder = useFolder();

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
