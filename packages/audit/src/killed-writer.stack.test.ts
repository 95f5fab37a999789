import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { verifyFiles } from './verify-files.ts';

let folder: string;
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'farpoint-audit-'));
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

const files = () => readdirSync(folder).map((name) => join(folder, name));

it('a chain goes on over writers that are killed while they write, and over full files', async () => {
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
