import { readFile } from 'node:fs/promises';
import { expect, test } from 'vitest';
import type * as codecModule from './codec.ts';
import { loadCodec } from './codec.ts';
import { loadCodecFromDisk } from './load-node.ts';

/** Another instance of the module, for this test alone: the shared one may have loaded the codec already. */
const FRESH = './codec.ts?fresh';

test('refuses an invalid module, and tries the next source', async () => {
  const fresh = (await import(FRESH)) as typeof codecModule;
  const refusal = { name: 'CodecError', code: 'not-loadable' };
  await expect(fresh.loadCodec(new Uint8Array([1, 2, 3]))).rejects.toMatchObject(refusal);
  expect(() => fresh.loadCodecSync(new Uint8Array([0]))).toThrow(expect.objectContaining(refusal));
  const codec = await fresh.loadCodec(
    await readFile(new URL('../pkg/farpoint_codec_bg.wasm', import.meta.url)),
  );
  expect(codec.memory.buffer.byteLength).toBeGreaterThan(0);
});

test('loads one module per thread, however often it is asked', async () => {
  const codec = await loadCodecFromDisk();
  expect(await loadCodec(new Uint8Array([1]))).toBe(codec);
});
