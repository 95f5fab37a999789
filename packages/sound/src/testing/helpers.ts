/** Helpers for this package's tests. */
import { spawnSync } from 'node:child_process';
import { ADDON_FILE } from '../build.ts';

/** Tests that need the program are skipped without it, and then name the command that builds it. */
export const SOUND_SUITE = {
  skip: spawnSync(ADDON_FILE, ['--version']).status !== 0,
  note: 'needs GStreamer and the program: docs/sound.md; pnpm build:native sound',
};

export function nowMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}

/** A list that can be waited for. */
export class Arrivals<T> {
  readonly all: T[] = [];
  #waiting: (() => void)[] = [];

  readonly add = (item: T): void => {
    this.all.push(item);
    const waiting = this.#waiting;
    this.#waiting = [];
    for (const each of waiting) each();
  };

  /** Resolves once there are so many. */
  async atLeast(count: number): Promise<T[]> {
    while (this.all.length < count) await new Promise<void>((resolve) => this.#waiting.push(resolve));
    return this.all;
  }
}
