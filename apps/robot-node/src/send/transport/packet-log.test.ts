import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { PacketLog } from './packet-log.ts';

const folder = useFolder();

it('writes what was sent, oldest first, and overwrites the oldest entries when full', () => {
  const path = join(folder, 'sent.csv');
  const log = new PacketLog(path, 2);
  log.add(1, 0, 10.25);
  log.add(1, 1200, 10.5);
  log.add(2, 0, 43);
  log.write();
  expect(readFileSync(path, 'utf8')).toBe('frameNumber,sequenceOffset,sentMs\n1,1200,10.5000\n2,0,43\n');
});
