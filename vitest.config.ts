import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['{packages,apps,wasm-codec,bench,scripts}/**/*.test.ts'],
    setupFiles: ['scripts/lib/test-setup.ts'],
    exclude: ['**/node_modules/**', '**/dist/**', '**/target/**'],
  },
});
