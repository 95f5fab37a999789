/** The robot program whose state is in memory: it says so, and what to do. */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { LoggingProcess } from '@farpoint/service/testing';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { checkState } from './doctor/check-files.ts';

const program = fileURLToPath(new URL('../main.ts', import.meta.url));

it.skipIf(!existsSync('/dev/shm'))(
  'warns at its start, and so does the doctor',
  { timeout: 30_000 },
  async () => {
    const stateFolder = testFolder('/dev/shm');
    const args = ['--state-dir', stateFolder, '--sim-size', '16', '--admin-port', '0'];
    const robot = new LoggingProcess(program, [...args, '--signaling', 'ws://127.0.0.1:9']);
    try {
      const said = await robot.logged(/will forget its emergency stop/);
      expect(said).toMatchObject({
        msg: expect.stringContaining(`${stateFolder} is in memory`) as string,
        remedy: expect.stringContaining('-v /var/lib/farpoint:/var/lib/farpoint') as string,
      });
      const robotKey = join(stateFolder, 'robot-1.key.json');
      expect(checkState({ stateFolder, robotKey })).toMatchObject([{ verdict: 'warn' }]);
    } finally {
      robot.child.kill('SIGKILL');
      await robot.exited;
    }
  },
);
