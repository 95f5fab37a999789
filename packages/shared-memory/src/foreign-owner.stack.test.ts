import { chmodSync, chownSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { beforeEach, describe, expect, it } from 'vitest';
import { CloudProducer } from './cloud/cloud-producer.ts';
import { CloudReader } from './cloud/cloud-reader.ts';
import { cloudFile } from './cloud/layout.ts';
import { MappedFile } from './mapped-file.ts';
import { ReferenceControlWriter } from './reference/control-writer.ts';
import { referenceFiles } from './reference/layout.ts';
import { ADDON_SUITE, errorOf, scratchFolder } from './testing/helpers.ts';

/** Only root can give files away. */
const isRoot = process.geteuid?.() === 0;
const SOMEBODY = 54_321;

let folder: string;
let path: string;
beforeEach(() => {
  folder = scratchFolder();
  path = join(folder, 'file');
});

describe.skipIf(ADDON_SUITE.skip || !isRoot)(`files of other users (${ADDON_SUITE.note}; needs root)`, () => {
  it('are refused, whatever their permissions, unless that user’s or everybody’s are allowed', () => {
    writeFileSync(path, 'x'.repeat(10));
    chownSync(path, SOMEBODY, 0);
    for (const mode of [0o600, 0o660, 0o644, 0o400]) {
      chmodSync(path, mode);
      for (const options of [{}, { writable: true }, { create: true, bytes: 10 }, { owner: SOMEBODY + 1 }])
        expect(errorOf(() => MappedFile.open(path, options))).toMatchObject({
          code: 'foreign-owner',
          file: path,
          message: expect.stringContaining(`--shm-owner ${SOMEBODY}`),
        });
    }
    for (const owner of [SOMEBODY, 'any'] as const) MappedFile.open(path, { owner }).close();
  });

  it('a file that somebody else has made first is not resized either', () => {
    writeFileSync(path, 'x'.repeat(10));
    chownSync(path, SOMEBODY, 0);
    expect(errorOf(() => MappedFile.open(path, { create: true, bytes: 20 })).code).toBe('foreign-owner');
    expect(MappedFile.open(path, { owner: SOMEBODY }).bytes).toBe(10);
  });

  it('clouds of a stranger are not read, and velocities are not written where one can change them', () => {
    using producer = new CloudProducer({ folder, format: 'points', maxPoints: 10, framesPerSecond: 30 });
    expect(producer).toBeDefined();
    chownSync(cloudFile(folder), SOMEBODY, 0);
    expect(errorOf(() => CloudReader.open(folder)).code).toBe('foreign-owner');
    CloudReader.open(folder, SOMEBODY).close();
    new ReferenceControlWriter({ folder, silenceMs: 100 }).close();
    chownSync(referenceFiles(folder).busy, SOMEBODY, 0);
    const open = (owner?: number) => new ReferenceControlWriter({ folder, silenceMs: 100, owner });
    expect(errorOf(() => open()).code).toBe('foreign-owner');
    open(SOMEBODY).close();
  });
});
