/** What `pnpm dev --lan` needs besides: the built page, which signaling serves by HTTPS, and a key for grants. */
import { existsSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { root, run } from './run.ts';

export interface DevLan {
  signalingArgs: string[];
  robotArgs: string[];
  /** Folder of the built page. */
  webRoot: string;
}

/** @throws {Error} with what the page's build or the key's maker said */
export async function devLan(ports: { lan: number; install: number }): Promise<DevLan> {
  const folder = join(root, '.farpoint', 'lan');
  const key = join(folder, 'grant-key.json');
  const keys = join(folder, 'grant-keys.json');
  const page = join(root, 'apps', 'webxr');
  if (!existsSync(key)) {
    mkdirSync(folder, { recursive: true, mode: 0o700 });
    const signaling = join(root, 'apps', 'signaling', 'src', 'main.ts');
    await must('node', [signaling, 'grant', 'keygen', '--key', key, '--keys', keys]);
  }
  await must('node', ['node_modules/vite/bin/vite.js', 'build', '--logLevel', 'error'], page);
  return {
    webRoot: join(page, 'dist'),
    // Robots admit only whom they have a grant for, so everybody may reach the service.
    signalingArgs: [
      ...['--lan', '--open', '--pair-key', key, '--lan-port', String(ports.lan)],
      ...['--lan-install-port', String(ports.install)],
    ],
    robotArgs: ['--grant-keys', keys],
  };
}

async function must(program: string, args: string[], cwd = root): Promise<void> {
  const { code, output } = await run(program, args, { cwd });
  if (code !== 0) throw new Error(output.trim());
}
