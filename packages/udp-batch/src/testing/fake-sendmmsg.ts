/** A kernel that takes less than it is given, for programs that are started with its environment; see fake_sendmmsg.c. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export class FakeSendmmsg {
  readonly #folder: string;
  readonly #library: string;

  private constructor(folder: string, library: string) {
    this.#folder = folder;
    this.#library = library;
  }

  /** @returns `null` without Linux or a C compiler */
  static build(): FakeSendmmsg | null {
    if (process.platform !== 'linux') return null;
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-sendmmsg-'));
    const library = join(folder, 'fake_sendmmsg.so');
    const source = join(import.meta.dirname, 'fake_sendmmsg.c');
    const flags = ['-shared', '-fPIC', '-O1', '-D_GNU_SOURCE', '-Wall', '-Werror'];
    const { status, error } = spawnSync('cc', [...flags, '-o', library, source]);
    if (error === undefined && status === 0) return new FakeSendmmsg(folder, library);
    rmSync(folder, { recursive: true, force: true });
    return null;
  }

  get #log(): string {
    return join(this.#folder, 'calls');
  }

  /** The environment of a program whose calls end as the script says. */
  env(script: string): Record<string, string> {
    rmSync(this.#log, { force: true });
    return { LD_PRELOAD: this.#library, SENDMMSG_SCRIPT: script, SENDMMSG_LOG: this.#log };
  }

  /** The calls of the last program: the segment's size of each message, 0 for none. */
  get calls(): number[][] {
    const lines = readFileSync(this.#log, 'utf8').trimEnd().split('\n');
    return lines.map((line) => line.split(' ').map(Number));
  }

  close(): void {
    rmSync(this.#folder, { recursive: true, force: true });
  }
}
