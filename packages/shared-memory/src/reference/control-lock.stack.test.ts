/** The lock of the command block between processes. */
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { zeroTwist } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { ADDON_SUITE, errorOf, scratchFolder } from '../testing/helpers.ts';
import { ReferenceControlReader } from './control-reader.ts';
import { ReferenceControlWriter } from './control-writer.ts';

const PROGRAM = join(import.meta.dirname, '..', 'testing', 'driving-writer.ts');

describe.skipIf(ADDON_SUITE.skip)(`the command block's lock (${ADDON_SUITE.note})`, () => {
  it('names the process that holds it, and dies with that process', async () => {
    const folder = scratchFolder();
    const child = spawn(process.execPath, [PROGRAM, '--folder', folder], {
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    await once(child.stdout, 'data');
    const open = () => new ReferenceControlWriter({ folder, silenceMs: 1000 });
    expect(errorOf(open)).toMatchObject({ code: 'in-use', holder: child.pid });
    const gone = once(child, 'exit');
    child.kill('SIGKILL');
    await gone;
    using writer = open();
    writer.write(zeroTwist());
    using reader = new ReferenceControlReader(folder);
    expect(reader.read()?.twist).toEqual(zeroTwist());
  });
});
