import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, it, vi } from 'vitest';
import { verifyFiles } from './verify-files.ts';

it('a chain goes on over writers that are killed while they write, and over full files', async () => {
  const folder = testFolder();
  const files = () => readdirSync(folder).map((name) => join(folder, name));
  for (let kill = 1; kill <= 5; kill++) {
    const program = join(import.meta.dirname, 'testing', 'writing-process.ts');
    const child = spawn(process.execPath, [program, join(folder, 'audit.jsonl')], {
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    await once(child.stdout, 'data');
    await vi.waitFor(() => expect(files().length).toBeGreaterThan(2 * kill), { timeout: 20_000 });
    child.kill('SIGKILL');
    await once(child, 'close');
  }
  const result = verifyFiles(files());
  expect(result).not.toHaveProperty('kind');
  expect(result).toMatchObject({ first: { sequence: 0 } });
});
