import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { JsonLinesFile } from './json-lines-file.ts';
import { useFolder } from './testing/folder.ts';

const folder = useFolder();

describe('JsonLinesFile', () => {
  it('writes one object per line, all of them before it is closed', async () => {
    const path = join(folder, 'a.jsonl');
    const file = new JsonLinesFile(path, (error) => expect.unreachable(error.message));
    for (let i = 0; i < 1000; i++) file.write({ i, text: 'ä\n' });
    await file.close();
    const lines = readFileSync(path, 'utf8').trimEnd().split('\n');
    expect(lines.map((line) => JSON.parse(line).i)).toEqual([...Array(1000).keys()]);
    expect(file.dropped).toBe(0);
  });

  it('reports a file that cannot be written, and still closes', async () => {
    const told = Promise.withResolvers<Error>();
    const file = new JsonLinesFile(join(folder, 'none', 'a.jsonl'), told.resolve);
    expect((await told.promise).message).toContain('ENOENT');
    await file.close();
  });
});
