/** Checks of what this machine has: UDP ports, and blocks and locks in shared memory. */
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { isAvailable, ReferenceControlWriter, StopBlockWriter } from '@farpoint/shared-memory';
import { describe, expect, it } from 'vitest';
import { checkSharedMemory } from './check-files.ts';
import { checkUdpPorts } from './check-ice.ts';
import { checkStops } from './check-stops.ts';

const folder = useFolder();

it('UDP ports: too few, privileged', async () => {
  const verdicts = async (range: [number, number]) =>
    (await checkUdpPorts(range, 4)).map(({ verdict }) => verdict);
  expect(await checkUdpPorts(null, 4)).toEqual([]);
  expect(await verdicts([50_000, 50_003])).toEqual(['warn']);
  expect(await verdicts([50_000, 50_400])).toEqual(['ok']);
});

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
