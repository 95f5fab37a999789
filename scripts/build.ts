/** `pnpm build`: builds what is deployed: the bundles of the signaling service and the issuer, and the static web app. */
import { run } from './lib/run.ts';

for (const name of ['@farpoint/signaling', '@farpoint/issuer', '@farpoint/webxr']) {
  console.log(`building ${name}`);
  const { code, output } = await run('pnpm', ['--filter', name, 'run', 'build']);
  if (code !== 0) {
    console.error(output);
    process.exit(1);
  }
}
