/**
 * Remembers the emergency stop across restarts of the robot, and whether the last run ended cleanly. A reset must not
 * start the machine (ISO 13850, 4.1.4), and a crash does not release the stop. After either, the robot starts with
 * its emergency stop latched.
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { type EstopStart, type RobotStop, robotStops } from '@farpoint/protocol';
import type { EstopSource } from '@farpoint/safety';
import { makeFolder, replaceFile } from '@farpoint/service';
import { z } from 'zod';
import { ReleaseRequest } from './release-request.ts';

const runSchema = z.strictObject({
  version: z.literal(1),
  /** True while the robot runs. */
  running: z.boolean(),
  /** Who latched the emergency stop; `null` while it is released. */
  latchedBy: z.enum(['operator', 'robot']).nullable(),
  /** The stops at the robot that hold it. Robots before version 0.3 leave it out. */
  heldBy: z.array(z.enum(robotStops)).max(robotStops.length).default([]),
});

export type Run = z.infer<typeof runSchema>;

export interface RunStart {
  /** `null`: the robot may start unlatched. */
  latched: { by: EstopSource; reason: EstopStart; detail: string } | null;
  /** The stops at the robot that held it when the last run ended. */
  heldBy: readonly RobotStop[];
}

export class EstopJournal {
  readonly start: RunStart;
  /** By which somebody at the robot asks for the release. */
  readonly request: ReleaseRequest;
  readonly #path: string;
  readonly #onFault: (error: Error) => void;
  #latchedBy: EstopSource | null;
  #heldBy: readonly RobotStop[];
  #ended = false;

  /**
   * Reads the state that the last run left, and records that a new run has begun.
   *
   * @param folder created if it does not exist
   * @param robotId names the file, because robots on one machine may share the folder
   * @param onFault called if a change could not be written; the robot goes on, and its next start is latched
   */
  constructor(folder: string, robotId: string, onFault: (error: Error) => void) {
    this.#path = runFile(folder, robotId);
    this.request = new ReleaseRequest(folder, robotId);
    this.#onFault = onFault;
    const last = lastRun(this.#path);
    let { latched } = last;
    const { heldBy } = last;
    this.#heldBy = heldBy;
    this.#latchedBy = latched?.by ?? null;
    try {
      makeFolder(folder, 0o750);
      this.#write(true);
      // Whoever asked before the start cannot know of it.
      this.request.withdraw();
    } catch (error) {
      latched ??= { by: 'robot', reason: 'unwritable', detail: (error as Error).message };
      this.#latchedBy = latched.by;
    }
    this.start = { latched, heldBy };
  }

  /** Records that the emergency stop was latched or released. */
  changed(latchedBy: EstopSource | null, heldBy: readonly RobotStop[] = []): void {
    const isSame = latchedBy === this.#latchedBy && heldBy.join() === this.#heldBy.join();
    if (this.#ended || isSame) return;
    this.#latchedBy = latchedBy;
    this.#heldBy = heldBy;
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
    const run: Run = { version: 1, running, latchedBy: this.#latchedBy, heldBy: [...this.#heldBy] };
    replaceFile(this.#path, `${JSON.stringify(run)}\n`, 0o640);
  }
}

function runFile(folder: string, robotId: string): string {
  return join(folder, `${robotId}.run.json`);
}

/** What a robot remembers now; `null` if it has never run, or that cannot be read. */
export function keptRun(folder: string, robotId: string): Run | null {
  try {
    return runSchema.parse(JSON.parse(readFileSync(runFile(folder, robotId), 'utf8')));
  } catch {
    return null;
  }
}

function lastRun(path: string): RunStart {
  const unreadable = (detail: string): RunStart => ({
    latched: { by: 'robot', reason: 'unreadable', detail },
    heldBy: [],
  });
  let text: string;
  try {
    text = readFileSync(path, 'utf8');
  } catch (error) {
    if ((error as NodeJS.ErrnoException).code === 'ENOENT') return { latched: null, heldBy: [] };
    return unreadable((error as Error).message);
  }
  let run: Run;
  try {
    run = runSchema.parse(JSON.parse(text));
  } catch {
    return unreadable(`${path} is not what a robot writes`);
  }
  const { latchedBy: by, heldBy } = run;
  if (by !== null)
    return {
      latched: { by, reason: 'was-latched', detail: 'it was latched when the robot last ran' },
      heldBy,
    };
  if (!run.running) return { latched: null, heldBy };
  const detail = 'the robot did not end in order when it last ran';
  return { latched: { by: 'robot', reason: 'unclean-exit', detail }, heldBy };
}
