import { readdir, stat } from 'node:fs/promises';
import { basename, join } from 'node:path';
import type { RecordControl } from '../../tell/record-control.ts';
import type { ActionPort, ActionResult, CommandActor, CommandOrder } from './command-actor.ts';

const failed = (detail: string): ActionResult => ({ state: 'failed', detail });

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

  begin(order: CommandOrder, port: ActionPort): null {
    this.#do(order).then(port.end, (error: unknown) =>
      port.end(failed(error instanceof Error ? error.message : String(error))),
    );
    return null;
  }

  async close(): Promise<void> {}

  async #do({ action, by, text }: CommandOrder): Promise<ActionResult> {
    const recording = this.#recording;
    if (recording === null || action.kind !== 'record') return failed('nothing can be recorded here');
    if (action.action === 'start') return this.#start(recording);
    if (!recording.writes) return failed('nothing is being recorded');
    if (action.action === 'bookmark') {
      recording.bookmark(by, text === '' ? `bookmark ${++this.#bookmarks}` : text);
      return { state: 'done', detail: text };
    }
    if (recording.isOwn) return failed('the robot itself records, until it ends');
    const path = await recording.stop();
    return { state: 'done', detail: path === null ? '' : `${basename(path)} is complete` };
  }

  async #start(recording: RecordControl): Promise<ActionResult> {
    const { robotId, folder, writes } = recording;
    if (folder === null) return failed('no folder for recordings is configured');
    if (writes) return failed('the session is being recorded already');
    const bytes = await recordedBytes(folder.path);
    if (bytes === null) return failed('the folder for recordings cannot be read');
    if (bytes >= folder.mostBytes) return failed('the folder has no more room for recordings');
    const name = recordingName(robotId, this.#now());
    await recording.start(join(folder.path, name));
    return { state: 'done', detail: name };
  }
}

/** @returns a name that sorts by time, and that every file system takes: `robot-1-20261127T093501Z.mcap` */
function recordingName(robotId: string, now: Date): string {
  const stamp = now.toISOString().replaceAll(/[-:]|\.\d+/g, '');
  return `${robotId.replaceAll(/[^\w.-]/g, '_')}-${stamp}.mcap`;
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
