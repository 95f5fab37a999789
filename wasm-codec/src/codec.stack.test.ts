/** In a thread of its own: pure tests share one, in which another test may have loaded the module already. */
import { expect, test } from 'vitest';
import { loadCodec, loadCodecSync } from './codec.ts';
import { loadCodecFromDisk } from './load-node.ts';

test('refuses an invalid module, and tries the next source', async () => {
  const refusal = { name: 'CodecError', code: 'not-loadable' };
  await expect(loadCodec(new Uint8Array([1, 2, 3]))).rejects.toMatchObject(refusal);
  expect(() => loadCodecSync(new Uint8Array([0]))).toThrow(expect.objectContaining(refusal));
  const codec = await loadCodecFromDisk();
  expect(codec.memory.buffer.byteLength).toBeGreaterThan(0);
  // One module per thread, whoever asks.
  expect(await loadCodec(new Uint8Array([1]))).toBe(codec);
});
