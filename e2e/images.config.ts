/** `pnpm docs:images`: takes the documents' pictures of the page anew, each from the real programs. */
import { defineConfig } from '@playwright/test';
import tests from './playwright.config.ts';

export default defineConfig({
  ...tests,
  projects: [{ name: 'images', testDir: 'images', outputDir: 'output/images' }],
});
