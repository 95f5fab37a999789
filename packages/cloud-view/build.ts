/** `pnpm --filter @farpoint/cloud-view build`: writes `dist`, which `pnpm pack` puts in the tarball. */
import { buildBrowserPackage } from '../../scripts/lib/browser-package.ts';

await buildBrowserPackage({
  folder: import.meta.dirname,
  entries: ['index.ts'],
  external: ['@farpoint/operator', 'three'],
});
