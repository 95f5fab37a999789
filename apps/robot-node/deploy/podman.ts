import { spawnSync } from 'node:child_process';
import { existsSync, rmSync } from 'node:fs';
import { join } from 'node:path';

/** A command's output and exit code. */
export interface Ended {
  code: number | null;
  stdout: string;
  stderr: string;
}

/** Podman with its own storage in a folder, so that the machine's storage is untouched. */
export class Podman {
  readonly #folder: string;
  readonly #options: string[];

  constructor(folder: string) {
    this.#folder = folder;
    const at = (name: string) => join(folder, name);
    this.#options = ['--root', at('storage'), '--runroot', at('run'), '--tmpdir', at('tmp')];
    this.#options.push('--cgroup-manager', 'cgroupfs', '--events-backend', 'none');
    // crun, podman's default, does not support cgroups version 1.
    if (!existsSync('/sys/fs/cgroup/cgroup.controllers')) this.#options.push('--runtime', 'runc');
  }

  command(...args: string[]): Ended {
    const { status, stdout, stderr } = spawnSync('podman', [...this.#options, ...args], {
      encoding: 'utf8',
      // Without systemd, nothing runs a container's health check at intervals. The caller runs it instead.
      env: { ...process.env, DISABLE_HC_SYSTEMD: 'true' },
      maxBuffer: 2 ** 28,
    });
    return { code: status, stdout: stdout.trim(), stderr: stderr.trim() };
  }

  /** @throws {Error} with the end of the output if the command fails */
  demand(...args: string[]): string {
    const { code, stdout, stderr } = this.command(...args);
    if (code !== 0) throw new Error(`podman ${args[0]}:\n${`${stdout}\n${stderr}`.slice(-4000)}`);
    return stdout;
  }

  /** Removes images, containers and storage. */
  remove(): void {
    this.command('rmi', '--all', '--force');
    // A mount that podman left behind would prevent the folder's removal.
    spawnSync('umount', [join(this.#folder, 'storage/overlay')]);
    for (const part of ['storage', 'run', 'tmp'])
      rmSync(join(this.#folder, part), { recursive: true, force: true });
  }
}
