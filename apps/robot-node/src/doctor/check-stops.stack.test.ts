import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { isAvailable, StopBlockWriter } from '@farpoint/shared-memory';
import { afterAll, describe, expect, it } from 'vitest';
import { checkStops } from './check-stops.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-doctor-stops-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
const path = join(folder, 'stop');
const shm = { path, silentMs: 100 };

describe.skipIf(!isAvailable())('checkStops', () => {
  it('judges a block by its counter and its stop byte', async () => {
    const verdict = async (wait: () => void) => {
      const host = { isTerminal: true, wait: async () => wait() };
      return (await checkStops({ shm, key: false }, false, host)).map(({ verdict, detail }) => [
        verdict,
        detail,
      ]);
    };
    expect(await verdict(() => undefined)).toEqual([
      ['fail', expect.stringContaining('there is no such file: the robot stands')],
    ]);
    using writer = new StopBlockWriter(path);
    expect(await verdict(() => undefined)).toEqual([['fail', expect.stringContaining('stands still')]]);
    expect(await verdict(() => writer.write(true))).toEqual([['warn', expect.stringContaining('says stop')]]);
    expect(await verdict(() => writer.write(false))).toEqual([['ok', expect.stringContaining('is written')]]);
  });

  it('says what a line and a console lack, and leaves a running robot its line', async () => {
    const gpio = { chip: '/dev/gpiochip999', line: 1, activeLow: false };
    const host = { isTerminal: false, wait: async () => undefined };
    const found = await checkStops({ gpio, key: true }, false, host);
    expect(found.map(({ verdict }) => verdict)).toEqual(['fail', 'warn']);
    expect(await checkStops({ gpio, key: false }, true, host)).toEqual([]);
    expect(await checkStops({ key: false }, false, host)).toEqual([]);
  });
});
