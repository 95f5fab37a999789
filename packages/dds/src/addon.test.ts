import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { requireAddon } from './addon.ts';
import { faultOf } from './testing/helpers.ts';

const folder = useFolder();

describe('without the addon', () => {
  it('one sentence says what is missing and how to fix it', () => {
    const fault = faultOf(() => requireAddon(join(folder, 'farpoint_dds.node')));
    expect(fault.code).toBe('unavailable');
    expect(fault.message).toBe(
      'the DDS addon is not built; install CycloneDDS 0.10 and a C compiler ' +
        '(Debian: `apt-get install cyclonedds-dev build-essential python3`) and run `pnpm build:native dds`',
    );
  });

  it('does the same if the addon cannot be loaded', () => {
    const file = join(folder, 'broken.node');
    writeFileSync(file, 'no library');
    const fault = faultOf(() => requireAddon(file));
    expect(fault.code).toBe('unavailable');
    expect(fault.message).toContain('cannot be loaded');
    expect(fault.remedy).toContain('apt-get install cyclonedds-dev');
  });
});
