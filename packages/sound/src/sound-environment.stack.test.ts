import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { afterEach, expect, it, vi } from 'vitest';
import { SoundProcess } from './sound-process.ts';

afterEach(() => vi.unstubAllEnvs());

it('the program gets no token of ours', async () => {
  const folder = testFolder();
  const program = join(folder, 'program');
  writeFileSync(program, `#!/bin/sh\nenv > ${folder}/environment\n`, { mode: 0o755 });
  vi.stubEnv('FARPOINT_ROBOT_TOKEN', 'hunter2');
  vi.stubEnv('AWS_SECRET_ACCESS_KEY', 'hunter2');
  vi.stubEnv('GST_DEBUG', '1');
  let ended = () => {};
  const end = new Promise<void>((resolve) => {
    ended = resolve;
  });
  const process = new SoundProcess({
    ...{ role: 'microphone', pipeline: 'audiotestsrc', silenceMs: 0, bitsPerS: 32_000, program },
    onFailure: () => ended(),
  });
  try {
    await end;
    const environment = readFileSync(join(folder, 'environment'), 'utf8');
    expect(environment).toContain('GST_DEBUG=1');
    expect(environment).not.toContain('hunter2');
  } finally {
    await process.close();
  }
});
