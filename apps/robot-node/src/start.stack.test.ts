/**
 * The robot program when it cannot start: one line that says what is wrong and what to do, in JSON and in text. What each
 * fault is called: doctor/start-failure.test.ts.
 */
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { LoggingProcess } from '@farpoint/service/testing';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';

const program = fileURLToPath(new URL('./main.ts', import.meta.url));
const folder = useFolder();
const words = join(folder, 'words.txt');
writeFileSync(words, 'no cloud, no recording\n');

const missing = join(folder, 'missing');
/** A folder of their own: no other robot of this machine is in the way. */
const COMMON = ['--admin-port', '0', '--state-dir', join(folder, 'state')];

describe('a robot that cannot start', () => {
  it('says so once, with what to do, and without a stack', async () => {
    const robot = new LoggingProcess(program, ['--record', words, ...COMMON, '--sim-size', '16']);
    const said = await robot.logged(/^could not start: /);
    expect(await robot.exited).toBe(1);
    expect(said.msg).toContain(`${words} already exists`);
    expect(said.remedy).toContain('name another file');
    expect(said).not.toHaveProperty('err');
  });

  it('as text, the line ends with an arrow and the remedy', () => {
    const args = [program, '--source', 'pcd', '--path', missing, '--log-format', 'text', ...COMMON];
    const { stdout, status } = spawnSync(process.execPath, args, { encoding: 'utf8' });
    expect(status).toBe(1);
    expect(stdout).toContain(
      `could not start: pcd: ${missing} does not exist → set source.path (--path) to a PCD file`,
    );
    expect(stdout).not.toContain('    at ');
  });
});
