import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { zeroTwist } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, test } from 'vitest';
import { CommandLog } from './command-log.ts';

const folder = useFolder();

function written(log: { write(): void }, path: string): string[] {
  log.write();
  return readFileSync(path, 'utf8').split('\n');
}

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
