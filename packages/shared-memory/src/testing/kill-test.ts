/** Runs producer and reader as separate processes, which are killed repeatedly while frames flow. */
import { type ChildProcess, spawn } from 'node:child_process';
import { join } from 'node:path';
import { Random } from '@farpoint/network-sim/random';
import { MappedFile } from '../mapped-file.ts';
import { COUNT_BYTES, Counts } from './counts.ts';

export interface KillTestOptions {
  layout: 'reference' | 'farpoint';
  /** An empty folder. */
  folder: string;
  /** Ends when this many frames have been read, */
  frames: number;
  /** each of this many points, */
  points: number;
  /** and each side was killed at least this often. */
  leastKills: number;
  seed: number;
  /** Minimum and maximum time for which a process works, ms, not counting its start. */
  lifeMs: readonly [number, number];
}

export interface KillTestResult {
  frames: number;
  torn: number;
  /** Files that a reader could not use as they were, and opened again. */
  faults: number;
  producerKills: number;
  readerKills: number;
  /** Longest time without a frame, ms: includes both sides' restarts and all other delays. */
  longestPauseMs: number;
  seconds: number;
}

const LOOK_MS = 2;
/** After this long without a frame, the test counts as deadlocked, ms. */
const STANDSTILL_MS = 20_000;

/** @throws {Error} if frames stop flowing, or a process ends by itself */
export async function runKillTest(options: KillTestOptions): Promise<KillTestResult> {
  const { layout, folder, frames, points, leastKills, seed, lifeMs } = options;
  const log = join(folder, 'counts');
  using file = MappedFile.open(log, { bytes: COUNT_BYTES, create: true });
  const counts = new Counts(file);
  const random = new Random(seed, 0);
  const life = () => lifeMs[0] + random.next() * (lifeMs[1] - lifeMs[0]);
  const args = ['--layout', layout, '--folder', folder, '--points', String(points), '--log', log];
  const sides = [new Side('marked-producer.ts', args), new Side('checking-reader.ts', args)] as const;
  const began = performance.now();
  let lastFrames = 0;
  let lastMs = began;
  let longestPauseMs = 0;
  try {
    for (const side of sides) side.start(life());
    while (counts.frames < frames || sides.some(({ kills }) => kills < leastKills)) {
      await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
      for (const side of sides) await side.look(life);
      const now = performance.now();
      if (counts.frames !== lastFrames) {
        lastFrames = counts.frames;
        lastMs = now;
      }
      longestPauseMs = Math.max(longestPauseMs, now - lastMs);
      if (now - lastMs > STANDSTILL_MS) throw new Error(`no frame for ${STANDSTILL_MS / 1000} s`);
    }
    return {
      frames: counts.frames,
      torn: counts.torn,
      faults: counts.faults,
      producerKills: sides[0].kills,
      readerKills: sides[1].kills,
      longestPauseMs,
      seconds: (performance.now() - began) / 1000,
    };
  } finally {
    for (const side of sides) await side.kill();
  }
}

class Side {
  kills = 0;
  readonly #command: string[];
  #child: ChildProcess | null = null;
  #output = '';
  #killAtMs = 0;

  constructor(module: string, args: readonly string[]) {
    this.#command = [join(import.meta.dirname, module), ...args];
  }

  start(lifeMs: number): void {
    const child = spawn(process.execPath, this.#command, { stdio: ['ignore', 'pipe', 'pipe'] });
    this.#output = '';
    // The process reports when it starts working, which may take long on a busy machine.
    this.#killAtMs = Number.POSITIVE_INFINITY;
    child.stdout.once('data', () => {
      this.#killAtMs = performance.now() + lifeMs;
    });
    child.stderr.on('data', (data: Buffer) => {
      this.#output = `${this.#output}${data.toString()}`.slice(-4000);
    });
    this.#child = child;
  }

  /** Kills it when its time has come, and starts it again. */
  async look(life: () => number): Promise<void> {
    const { exitCode, signalCode } = this.#child ?? {};
    if (exitCode != null || signalCode != null)
      throw new Error(`${this.#command[0]} ended by itself (${exitCode ?? signalCode}):\n${this.#output}`);
    if (performance.now() < this.#killAtMs) return;
    await this.kill();
    this.kills++;
    this.start(life());
  }

  async kill(): Promise<void> {
    const child = this.#child;
    if (child === null || child.exitCode !== null || child.signalCode !== null) return;
    const ended = new Promise((resolve) => child.once('exit', resolve));
    child.kill('SIGKILL');
    await ended;
  }
}
