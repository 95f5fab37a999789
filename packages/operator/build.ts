/** `pnpm --filter @farpoint/operator build`: writes `dist`, which `pnpm pack` puts in the tarball. */
import { buildBrowserPackage } from '../../scripts/lib/browser-package.ts';

await buildBrowserPackage({
  folder: import.meta.dirname,
  entries: [
    'index.ts',
    'cloud/cloud-worker.ts',
    'memory/memory-worker.ts',
    'pictures/picture-worker.ts',
    'watch/stamp-worker.ts',
  ],
  assets: ['../../wasm-codec/pkg/farpoint_codec_bg.wasm'],
});
