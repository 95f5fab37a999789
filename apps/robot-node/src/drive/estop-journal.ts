/**
 * Remembers the emergency stop across restarts of the robot, and whether the last run ended cleanly. A reset must not
 * start the machine (ISO 13850, 4.1.4), and a crash does not release the stop. After either, the robot starts with
 * its emergency stop latched.
 */
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { EstopSource } from '@farpoint/safety';
import { replaceFile } from '@farpoint/service';
import { z } from 'zod';

const runSchema = z.strictObject({
  version: z.literal(1),
  /** True while the robot runs. */
  running: z.boolean(),
  /** Who latched the emergency stop; `null` while it is released. */
  latchedBy: z.enum(['operator', 'robot']).nullable(),
});

type Run = z.infer<typeof runSchema>;

/** Why a robot starts with its emergency stop latched. */
export type LatchedStart =
  | 'was-latched' // when the last run ended
  | 'unclean-exit' // the last run did not end in order
  | 'unreadable' // what the last run left cannot be read
  | 'unwritable'; // nothing can be remembered, so that the next start could not tell a crash

export interface RunStart {
  /** `null`: the robot may start unlatched. */
  latched: { by: EstopSource; reason: LatchedStart; detail: string } | null;
}

export class EstopJournal {
  readonly start: RunStart;
  readonly #path: string;
  readonly #onFault: (error: Error) => void;
  #latchedBy: EstopSource | null;
  #ended = false;

  /**
   * Reads the state that the last run left, and records that a new run has begun.
   *
   * @param folder created if it does not exist
   * @param robotId names the file, because robots on one machine may share the folder
   * @param onFault called if a change could not be written; the robot goes on, and its next start is latched
   */
  constructor(folder: string, robotId: string, onFault: (error: Error) => void) {
    this.#path = join(folder, `${robotId}.run.json`);
    this.#onFault = onFault;
    let latched = lastRun(this.#path);
    this.#latchedBy = latched?.by ?? null;
    try {
      mkdirSync(folder, { recursive: true, mode: 0o750 });
      this.#write(true);
    } catch (error) {
      latched ??= { by: 'robot', reason: 'unwritable', detail: (error as Error).message };
      this.#latchedBy = latched.by;
    }
    this.start = { latched };
  }

  /** Records that the emergency stop was latched or released. */
  changed(latchedBy: EstopSource | null): void {
    if (this.#ended || latchedBy === this.#latchedBy) return;
    this.#latchedBy = latchedBy;
    this.#tryWrite(true);
  }

  /** Records a clean end of the run. Nothing is recorded after it. */
  end(): void {
    if (this.#ended) return;
    this.#ended = true;
    this.#tryWrite(false);
  }

  #tryWrite(running: boolean): void {
    try {
      this.#write(running);
    } catch (error) {
      this.#onFault(error as Error);
    }
  }

  #write(running: boolean): void {
    const run: Run = { version: 1, running, latchedBy: this.#latchedBy };
    replaceFile(this.#path, `${JSON.stringify(run)}\n`, 0o640);
  }
}

function lastRun(path: string): RunStart['latched'] {
  let text: string;
  try {
    text = readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return null;
    return { by: 'robot', reason: 'unreadable', detail: (error as Error).message };
  }
  let run: Run;
  try {
    run = runSchema.parse(JSON.parse(text));
  } catch {
    return { by: 'robot', reason: 'unreadable', detail: `${path} is not what a robot writes` };
  }
  if (run.latchedBy !== null) {
    return { by: run.latchedBy, reason: 'was-latched', detail: 'it was latched when the robot last ran' };
  }
  if (!run.running) return null;
  return { by: 'robot', reason: 'unclean-exit', detail: 'the robot did not end in order when it last ran' };
}
