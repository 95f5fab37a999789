import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { isAvailable, ReferenceControlWriter } from '@farpoint/shared-memory';
import { afterAll, expect, it } from 'vitest';
import { checkSharedMemory } from './check-files.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-doctor-files-'));
afterAll(() => rmSync(folder, { recursive: true }));

it.skipIf(!isAvailable())('names the program that writes the velocities, unless that is the robot', () => {
  const sink = { kind: 'shm', folder, mode: 0o600, silenceMs: 150 } as const;
  const faults = (robotRuns: boolean) =>
    checkSharedMemory({ kind: 'pcd', path: 'x', frame: 'body' }, sink, robotRuns)
      .filter(({ verdict }) => verdict === 'fail')
      .map(({ detail }) => detail);
  expect(faults(false)).toEqual([]);
  using writer = new ReferenceControlWriter({ folder, silenceMs: 1000 });
  expect(writer.silences).toBe(0);
  expect(faults(false)).toEqual([
    expect.stringContaining(`is written by another program (process ${process.pid})`),
  ]);
  expect(faults(true)).toEqual([]);
});
