import { expect, test, vi } from 'vitest';

test('refuses an invalid module, and tries the next source', async () => {
  // Another test may have loaded the module already.
  vi.resetModules();
  const { loadCodec, loadCodecSync } = await import('./codec.ts');
  const { loadCodecFromDisk } = await import('./load-node.ts');
  await expect(loadCodec(new Uint8Array([1, 2, 3]))).rejects.toMatchObject({
    name: 'CodecError',
    code: 'not-loadable',
  });
  expect(() => loadCodecSync(new Uint8Array([0]))).toThrow(expect.objectContaining({ code: 'not-loadable' }));
  const codec = await loadCodecFromDisk();
  expect(codec.memory.buffer.byteLength).toBeGreaterThan(0);
  // One module per thread, whoever asks.
  expect(await loadCodec(new Uint8Array([1]))).toBe(codec);
});
