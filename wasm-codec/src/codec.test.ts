import { expect, test } from 'vitest';
import { loadCodec, loadCodecSync } from './codec.ts';
import { loadCodecFromDisk } from './load-node.ts';

test('a module that is none is refused, and the next source is tried', async () => {
  await expect(loadCodec(new Uint8Array([1, 2, 3]))).rejects.toMatchObject({
    name: 'CodecError',
    code: 'not-loadable',
  });
  expect(() => loadCodecSync(new Uint8Array([0]))).toThrow(expect.objectContaining({ code: 'not-loadable' }));
  const codec = await loadCodecFromDisk();
  expect(codec.memory.buffer.byteLength).toBeGreaterThan(0);
  // One module a thread, whoever asks.
  expect(await loadCodec(new Uint8Array([1]))).toBe(codec);
});
