import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { MeasurementLogs } from './measurement-logs.ts';

const folder = useFolder();

it('writes its logs to the folder that was asked for', () => {
  const measured = join(folder, 'new', 'folder');
  const logs = new MeasurementLogs(measured);
  logs.packets?.add(7, 1, 12.5);
  logs.write();
  expect(readdirSync(measured).sort()).toEqual(['commands.csv', 'frames.csv', 'packets.csv']);
  expect(readFileSync(join(measured, 'packets.csv'), 'utf8')).toMatch(/^.*\n7,1,12\.5000\n$/);
  expect(logs.statisticsFile).toBe(join(measured, 'streams.jsonl'));
});

it('keeps nothing without a folder', () => {
  const { packets, frames, commands, statisticsFile } = new MeasurementLogs(undefined);
  expect([packets, frames, commands, statisticsFile]).toEqual([undefined, undefined, undefined, undefined]);
});

it.runIf(process.platform === 'linux')('a folder that cannot be made is said, and nothing hangs', () => {
  expect(() => new MeasurementLogs('/proc/farpoint/measured')).toThrow(/ENOENT/);
});
