/** `pnpm docs:api [FOLDER]`: writes the API pages of the published packages, to docs/api unless told otherwise. */
import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { ApiPagesError, apiPages } from './generate.ts';

const folder = resolve(process.argv[2] ?? join(import.meta.dirname, '../../../docs/api'));
try {
  const pages = await apiPages();
  mkdirSync(folder, { recursive: true });
  for (const [file, text] of pages) writeFileSync(join(folder, file), text);
  console.log(`${folder}: ${[...pages.keys()].join(', ')}`);
} catch (error) {
  if (!(error instanceof ApiPagesError)) throw error;
  console.error(error.message);
  process.exitCode = 1;
}
