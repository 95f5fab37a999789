import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { zeroTwist } from '@farpoint/protocol';
import { afterAll, expect, test } from 'vitest';
import { PacketLog } from '../transport/packet-log.ts';
import { CommandLog } from './command-log.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-log-'));
afterAll(() => rmSync(folder, { recursive: true }));

function written(log: { write(): void }, path: string): string[] {
  log.write();
  return readFileSync(path, 'utf8').split('\n');
}

test('keeps the latest rows', () => {
  const path = join(folder, 'packets.csv');
  const log = new PacketLog(path, 3);
  for (let i = 0; i < 5; i++) log.add(i, i * 10, i + 0.12345);
  expect(written(log, path)).toEqual([
    'frameNumber,sequenceOffset,sentMs',
    '2,20,2.1235',
    '3,30,3.1235',
    '4,40,4.1235',
    '',
  ]);
});

test('records when a command was sent and received, and whether it was accepted', () => {
  const path = join(folder, 'commands.csv');
  const log = new CommandLog(path);
  const command = { sequence: 7, timeMs: 100.5, lease: 'x', deadMan: true, twist: zeroTwist() };
  log.add({ type: 'command', ...command }, true, 131);
  log.add({ type: 'command', ...command, sequence: 8 }, false, 151.25);
  expect(written(log, path)).toEqual([
    'sequence,sentMs,receivedMs,accepted',
    '7,100.5000,131,1',
    '8,100.5000,151.2500,0',
    '',
  ]);
});
