import { spawnSync } from 'node:child_process';
import { existsSync, rmSync } from 'node:fs';
import { join } from 'node:path';

/** What a command said, and how it ended. */
export interface Ended {
  code: number | null;
  stdout: string;
  stderr: string;
}

/** Podman with storage of its own in a folder, so that nothing of the machine's is touched. */
export class Podman {
  readonly #folder: string;
  readonly #options: string[];

  constructor(folder: string) {
    this.#folder = folder;
    const at = (name: string) => join(folder, name);
    this.#options = ['--root', at('storage'), '--runroot', at('run'), '--tmpdir', at('tmp')];
    this.#options.push('--cgroup-manager', 'cgroupfs', '--events-backend', 'none');
    // crun, which podman prefers, refuses cgroups of version 1.
    if (!existsSync('/sys/fs/cgroup/cgroup.controllers')) this.#options.push('--runtime', 'runc');
  }

  command(...args: string[]): Ended {
    const { status, stdout, stderr } = spawnSync('podman', [...this.#options, ...args], {
      encoding: 'utf8',
      // Without systemd nobody asks for a container's health at intervals: whoever wants it asks.
      env: { ...process.env, DISABLE_HC_SYSTEMD: 'true' },
      maxBuffer: 2 ** 28,
    });
    return { code: status, stdout: stdout.trim(), stderr: stderr.trim() };
  }

  /** @throws {Error} with the end of what it said where it fails */
  demand(...args: string[]): string {
    const { code, stdout, stderr } = this.command(...args);
    if (code !== 0) throw new Error(`podman ${args[0]}:\n${`${stdout}\n${stderr}`.slice(-4000)}`);
    return stdout;
  }

  /** Takes images, containers and storage away. */
  remove(): void {
    this.command('rmi', '--all', '--force');
    // What podman left mounted would keep the folder from going.
    spawnSync('umount', [join(this.#folder, 'storage/overlay')]);
    for (const part of ['storage', 'run', 'tmp'])
      rmSync(join(this.#folder, part), { recursive: true, force: true });
  }
}
