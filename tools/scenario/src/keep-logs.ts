/**
 * Set-up of the scenarios' tests: with FARPOINT_EVENT_LOGS, what happened in each scenario goes to a file of that folder, in the
 * order in which they ended. Two runs must leave the same files, byte for byte.
 */
import { createHash } from 'node:crypto';
import { appendFileSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { expect } from 'vitest';
import { Scenario } from './scenario.ts';

const folder = process.env.FARPOINT_EVENT_LOGS ?? '';
if (folder !== '') {
  mkdirSync(folder, { recursive: true });
  Scenario.onEnd = (log) => {
    const name = expect.getState().currentTestName ?? 'no test';
    const hash = createHash('sha256').update(name).digest('hex').slice(0, 16);
    appendFileSync(join(folder, `${hash}.log`), `${name}\n${log}`);
  };
}
