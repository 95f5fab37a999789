import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { signRevocations } from '@farpoint/grants';
import { makeIssuer } from '@farpoint/grants/testing';
import { silentLogger } from '@farpoint/service';
import { testFolder } from '@farpoint/service/testing/folder';
import { expect, it, vi } from 'vitest';
import { RevocationFiles } from './revocation-files.ts';

it('a file that leaves out what is revoked still does not keep it from robots that come later', async () => {
  const folder = testFolder();
  const path = join(folder, 'revoked.jws');
  const { signingKey } = await makeIssuer('k1');
  let nowS = 1000;
  const list = (seq: number, ...ids: string[]) =>
    signRevocations(
      { iss: 'test', iat: 0, seq, grants: ids.map((jti) => ({ jti, exp: 2000 })), subjects: [] },
      signingKey,
    );
  const [first, second, third] = [await list(1, 'a'), await list(2, 'b'), await list(3, 'a', 'b')];
  const log = { ...silentLogger(), warn: vi.fn() };
  const heard: string[] = [];
  let came = () => {};
  const files = new RevocationFiles({
    ...{ paths: [path], log: log as unknown as ReturnType<typeof silentLogger>, nowS: () => nowS },
    onChange: (text) => {
      heard.push(text);
      came();
    },
  });
  const write = (text: string) => {
    const changed = new Promise<void>((resolve) => {
      came = resolve;
    });
    writeFileSync(path, text);
    return changed;
  };
  try {
    writeFileSync(path, first);
    await files.start();
    expect([...files.lists]).toEqual([first]);
    await write(second);
    expect([...files.lists]).toEqual([first, second]);
    expect(log.warn.mock.lastCall?.[0]).toMatchObject({ missing: 1 });
    await write(third);
    expect([...files.lists]).toEqual([third]);
    nowS = 2000;
    await write(second);
    expect([...files.lists]).toEqual([second]);
  } finally {
    files.close();
  }
});
