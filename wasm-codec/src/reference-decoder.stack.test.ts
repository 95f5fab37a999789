/** The decoder in Python that was written from the specification alone reads what the codec writes. */
import { execFile, spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect, test } from 'vitest';

const AT_LEAST_3_9 = 'import sys; sys.exit(sys.version_info < (3, 9))';
const hasPython = spawnSync('python3', ['-c', AT_LEAST_3_9]).status === 0;
const path = (relative: string) => fileURLToPath(new URL(relative, import.meta.url));

test.skipIf(!hasPython)(
  'the reference decoder gives the points of all conformance vectors, and no others for changed bytes (needs python3 ≥ 3.9)',
  { timeout: 120_000 },
  async () => {
    const args = ['-B', path('../reference/organised_decoder.py'), path('../vectors/organised.json')];
    const { stdout } = await promisify(execFile)('python3', args);
    const lines = stdout.trim().split('\n');
    expect(lines).toHaveLength(9);
    for (const line of lines) expect(line).toMatch(/: \d+ packets, \d+ points, \d+ changed packets$/);
  },
);
