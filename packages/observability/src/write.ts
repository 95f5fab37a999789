/** `pnpm --filter @farpoint/observability run write`: writes the committed dashboards and alerts. */
import { writeFileSync } from 'node:fs';
import { files } from './files.ts';

for (const [path, text] of files()) writeFileSync(new URL(`../${path}`, import.meta.url), text);
