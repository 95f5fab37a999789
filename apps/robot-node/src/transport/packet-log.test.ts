import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterEach, expect, it } from 'vitest';
import { PacketLog } from './packet-log.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-packet-log-'));
afterEach(() => rmSync(folder, { recursive: true, force: true }));

it('writes what was sent, oldest first, and overwrites the oldest entries when full', () => {
  const path = join(folder, 'sent.csv');
  const log = new PacketLog(path, 2);
  log.add(1, 0, 10.25);
  log.add(1, 1200, 10.5);
  log.add(2, 0, 43);
  log.write();
  expect(readFileSync(path, 'utf8')).toBe('frameNumber,sequenceOffset,sentMs\n1,1200,10.5000\n2,0,43\n');
});
