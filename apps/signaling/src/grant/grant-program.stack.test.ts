/** The command as people run it. */
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';

const program = join(import.meta.dirname, '../main.ts');
const folder = useFolder();

function run(args: string[], input = '') {
  const { status, stdout, stderr } = spawnSync(process.execPath, [program, 'grant', ...args], {
    ...{ cwd: folder, encoding: 'utf8', input },
  });
  return { status, stdout, stderr };
}

it('from a key to a valid grant, with the default file names', () => {
  expect(run(['keygen'])).toMatchObject({ status: 0, stderr: '' });
  expect(JSON.parse(readFileSync(join(folder, 'grant-keys.json'), 'utf8'))).toMatchObject({
    keys: [{ crv: 'Ed25519' }],
  });
  const { stdout, status } = run([
    ...['issue', '--name', 'Ada', '--role', 'watch', '--robots', '*', '--with-key'],
  ]);
  expect([status, stdout.split('\n').length]).toEqual([0, 2]);
  const shown = run(['show', '-', '--keys', 'grant-keys.json', '--robot', 'r1'], stdout);
  expect(shown).toMatchObject({ status: 0, stdout: expect.stringMatching(/\nvalid\n$/) });
});

it('a mistake is one line without a stack', () => {
  const { status, stdout, stderr } = run(['issue', '--name', 'Ada']);
  expect([status, stdout]).toEqual([2, '']);
  expect(stderr).toBe('farpoint-signaling grant issue: needs either --for KEY or --with-key\n');
});
