/** A third party's project: `examples/own-page`, with the packages installed from their tarballs. */
import { cpSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { run } from './run.ts';

/**
 * Installs packed packages into a copy of the example. Nothing is downloaded: three.js comes from this workspace.
 *
 * @param folder destination of the copy
 * @param tarballs paths by the packages' names
 */
export async function installOwnPage(folder: string, tarballs: ReadonlyMap<string, string>): Promise<void> {
  mkdirSync(folder, { recursive: true });
  cpSync(join(repositoryRoot, 'examples/own-page'), folder, { recursive: true });
  for (const [name, tarball] of tarballs)
    cpSync(tarball, join(folder, `${name.replace(/^@/, '').replace('/', '-')}.tgz`));
  const overrides = Object.fromEntries(
    ['three', '@types/three'].map((name) => [
      name,
      `link:${join(repositoryRoot, 'packages/cloud-view/node_modules', name)}`,
    ]),
  );
  // JSON is valid YAML.
  writeFileSync(join(folder, 'pnpm-workspace.yaml'), JSON.stringify({ overrides }));
  await pnpm(['add', '--offline', '@types/three'], folder);
}

/** TypeScript's errors for a module that imports the installed packages; empty if there are none. */
export async function typeFaults(folder: string, module: string): Promise<string> {
  writeFileSync(join(folder, 'typed.ts'), module);
  const options = [
    '--ignoreConfig',
    '--noEmit',
    '--strict',
    '--skipLibCheck',
    '--module',
    'nodenext',
    '--target',
    'es2024',
  ];
  const args = [...options, '--lib', 'es2024,esnext.disposable,dom', '--types', '', 'typed.ts'];
  return (await run('tsc', args, { cwd: folder })).output;
}

async function pnpm(args: string[], cwd: string): Promise<void> {
  const { code, output } = await run('pnpm', args, { cwd });
  if (code !== 0) throw new Error(`pnpm ${args.join(' ')} in ${cwd}:\n${output}`);
}

const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.wasm': 'application/wasm',
};

/** Serves a folder's files on a free loopback port, like any static server. */
export async function serveFolder(folder: string): Promise<{ url: string; close: () => void }> {
  const server = createServer(({ url }, response) => {
    const path = normalize(new URL(url ?? '/', 'http://localhost').pathname);
    const file = join(folder, path === '/' ? 'index.html' : path);
    const type = TYPES[extname(file)];
    if (type === undefined || !existsSync(file)) response.writeHead(404).end();
    else response.writeHead(200, { 'Content-Type': type }).end(readFileSync(file));
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address() as AddressInfo;
  return { url: `http://localhost:${port}/`, close: () => server.close() };
}
