import type { Exit } from './managed-process.ts';

/** A program as it runs now. */
export interface RunningProgram {
  readonly exited: Promise<Exit>;
}

export interface KeepRunningOptions<Program extends RunningProgram> {
  /** Starts it again. */
  start(): Promise<Program>;
  /** How long to wait before restarting; grows with each call. */
  backoff: { nextMs(): number; reset(): void };
  now(): number;
  /** Ends early when the signal is aborted. */
  wait(ms: number, signal: AbortSignal): Promise<void>;
  /** It has ended, or did not start, and will be started in this many ms. */
  onEnd(program: Program, exit: Exit, waitMs: number): void;
  onFailure(error: unknown, waitMs: number): void;
  onStart(program: Program): void;
}

/** A program that ran for this long had started well: the next wait is short again, ms. */
const LASTED_MS = 10_000;

/** Restarts a program whenever it ends, until the signal is aborted. */
export async function keepRunning<Program extends RunningProgram>(
  first: Program,
  { start, backoff, now, wait, onEnd, onFailure, onStart }: KeepRunningOptions<Program>,
  signal: AbortSignal,
): Promise<void> {
  let program = first;
  let startedMs = now();
  while (!signal.aborted) {
    const exit = await program.exited;
    if (signal.aborted) return;
    if (now() - startedMs >= LASTED_MS) backoff.reset();
    let waitMs = backoff.nextMs();
    onEnd(program, exit, waitMs);
    for (;;) {
      await wait(waitMs, signal);
      if (signal.aborted) return;
      try {
        program = await start();
        break;
      } catch (error) {
        if (signal.aborted) return;
        waitMs = backoff.nextMs();
        onFailure(error, waitMs);
      }
    }
    startedMs = now();
    onStart(program);
  }
}
