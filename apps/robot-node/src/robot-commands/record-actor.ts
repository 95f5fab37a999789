import { readdir, stat } from 'node:fs/promises';
import { basename, join } from 'node:path';
import type { ActionResult, CommandActor } from './command-actor.ts';
import type { CommandAction, RecordAction } from './command-configuration.ts';
import { recordingName } from './recording-name.ts';

/** What operators may do with a robot's recordings. */
export interface RecordControl {
  readonly robotId: string;
  /** Where operators' recordings go, and the size of all of them, bytes; `null`: operators begin none. */
  readonly folder: { path: string; mostBytes: number } | null;
  /** Whether a file is being written now. */
  readonly writes: boolean;
  /** Whether that file is the robot's own, which no operator ends. */
  readonly isOwn: boolean;
  /** @throws {Error} if the file cannot be created */
  start(path: string): Promise<void>;
  /** @returns the path of the file @throws {Error} if it cannot be completed */
  stop(): Promise<string | null>;
  /** Marks the present instant. */
  bookmark(text: string): void;
}

/** Begins and ends recordings, and marks instants in them. */
export class RecordActor implements CommandActor {
  readonly #recording: RecordControl | null;
  readonly #now: () => Date;
  #bookmarks = 0;

  /** @param recording `null`: nothing can be recorded @param now the time of day, which names files */
  constructor(recording: RecordControl | null, now = () => new Date()) {
    this.#recording = recording;
    this.#now = now;
  }

  act(action: CommandAction, _timeoutMs: number, onResult: (result: ActionResult) => void, by: string): void {
    if (action.kind !== 'record') return;
    this.#do(action.action, by).then(onResult, (error: unknown) =>
      onResult({ done: false, detail: error instanceof Error ? error.message : String(error) }),
    );
  }

  async close(): Promise<void> {}

  async #do(action: RecordAction, by: string): Promise<ActionResult> {
    const recording = this.#recording;
    if (recording === null) return { done: false, detail: 'nothing can be recorded here' };
    if (action === 'start') return this.#start(recording);
    if (!recording.writes) return { done: false, detail: 'nothing is being recorded' };
    if (action === 'bookmark') {
      recording.bookmark(`${++this.#bookmarks}, by ${by}`);
      return { done: true, detail: `number ${this.#bookmarks}` };
    }
    if (recording.isOwn) return { done: false, detail: 'the robot itself records, until it ends' };
    const path = await recording.stop();
    return { done: true, detail: path === null ? '' : `${basename(path)} is complete` };
  }

  async #start(recording: RecordControl): Promise<ActionResult> {
    const { robotId, folder, writes } = recording;
    if (folder === null) return { done: false, detail: 'no folder for recordings is configured' };
    if (writes) return { done: false, detail: 'the session is being recorded already' };
    const bytes = await recordedBytes(folder.path);
    if (bytes === null) return { done: false, detail: 'the folder for recordings cannot be read' };
    if (bytes >= folder.mostBytes)
      return { done: false, detail: 'the folder has no more room for recordings' };
    const name = recordingName(robotId, this.#now());
    await recording.start(join(folder.path, name));
    return { done: true, detail: name };
  }
}

/** @returns the size of all recordings in a folder, bytes; `null` if it cannot be read */
async function recordedBytes(folder: string): Promise<number | null> {
  try {
    const names = (await readdir(folder)).filter((name) => name.endsWith('.mcap'));
    const sizes = await Promise.all(names.map(async (name) => (await stat(join(folder, name))).size));
    return sizes.reduce((sum, size) => sum + size, 0);
  } catch {
    return null;
  }
}
