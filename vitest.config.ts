import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['{packages,apps,wasm-codec,bench,scripts}/**/*.test.ts'],
    // No test measures time: a busy machine must not fail one.
    testTimeout: 30_000,
    setupFiles: ['scripts/lib/test-setup.ts'],
    exclude: ['**/node_modules/**', '**/dist/**', '**/target/**'],
  },
});
