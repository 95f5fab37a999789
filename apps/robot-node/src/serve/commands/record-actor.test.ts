import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import type { RecordControl } from '../../tell/record-control.ts';
import type { ActionResult } from './command-actor.ts';
import type { RecordAction } from './command-configuration.ts';
import { RecordActor } from './record-actor.ts';

const folder = mkdtempSync(join(tmpdir(), 'farpoint-record-actor-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

const NOW = new Date('2026-11-27T09:35:01.250Z');

interface Recording extends RecordControl {
  path: string | null;
  bookmarks: string[];
}

/** A recording that is only noted. @param own the file that the robot itself writes */
function setUp({ own = null as string | null, mostBytes = 1000, fails = '' } = {}) {
  const recording: Recording = {
    ...{ robotId: 'robot/1:b', folder: { path: folder, mostBytes }, path: own, bookmarks: [] },
    progress: { bytes: 0, forS: 0 },
    get writes() {
      return this.path !== null;
    },
    get isOwn() {
      return this.path !== null && this.path === own;
    },
    async start(path) {
      if (fails !== '') throw new Error(fails);
      this.path = path;
    },
    async stop() {
      const { path } = this;
      this.path = null;
      return path;
    },
    bookmark(by, text) {
      this.bookmarks.push(`${by}: ${text}`);
    },
  };
  return { recording, act: actOf(new RecordActor(recording, () => NOW)) };
}

function actOf(actor: RecordActor) {
  return (action: RecordAction, text = '') =>
    new Promise<ActionResult>((end) =>
      actor.begin(
        { action: { kind: 'record', action }, timeoutMs: 1000, by: 'Ann', text },
        { progress: () => undefined, end },
      ),
    );
}

const failed = (detail: string) => ({ state: 'failed', detail });

describe('RecordActor', () => {
  it('begins a recording in the folder, marks instants in it, and ends it', async () => {
    const { recording, act } = setUp();
    expect(await act('start')).toEqual({ state: 'done', detail: 'robot_1_b-20261127T093501Z.mcap' });
    expect(recording.path).toBe(join(folder, 'robot_1_b-20261127T093501Z.mcap'));
    expect(await act('start')).toEqual(failed('the session is being recorded already'));
    expect(await act('bookmark')).toEqual({ state: 'done', detail: '' });
    expect(await act('bookmark', 'wheel slips')).toEqual({ state: 'done', detail: 'wheel slips' });
    expect(recording.bookmarks).toEqual(['Ann: bookmark 1', 'Ann: wheel slips']);
    expect(await act('stop')).toEqual({
      state: 'done',
      detail: 'robot_1_b-20261127T093501Z.mcap is complete',
    });
    expect(await act('stop')).toEqual(failed('nothing is being recorded'));
    expect(await act('bookmark')).toEqual(failed('nothing is being recorded'));
  });

  it('marks instants in the robot’s own recording, and never ends it', async () => {
    const { recording, act } = setUp({ own: '/data/own.mcap' });
    expect(await act('bookmark')).toMatchObject({ state: 'done' });
    expect(await act('stop')).toEqual(failed('the robot itself records, until it ends'));
    expect(recording.path).toBe('/data/own.mcap');
  });

  it('begins none where the folder is full or missing, or nothing can be recorded', async () => {
    writeFileSync(join(folder, 'old.mcap'), new Uint8Array(600));
    writeFileSync(join(folder, 'other.txt'), new Uint8Array(5000));
    expect(await setUp({ mostBytes: 601 }).act('start')).toMatchObject({ state: 'done' });
    expect(await setUp({ mostBytes: 600 }).act('start')).toEqual(
      failed('the folder has no more room for recordings'),
    );
    const { recording, act } = setUp();
    Object.assign(recording, { folder: { path: join(folder, 'missing'), mostBytes: 1 } });
    expect(await act('start')).toEqual(failed('the folder for recordings cannot be read'));
    Object.assign(recording, { folder: null });
    expect(await act('start')).toMatchObject({ state: 'failed' });
    expect(await actOf(new RecordActor(null))('bookmark')).toEqual(failed('nothing can be recorded here'));
  });

  it('says why a file cannot be created', async () => {
    const { act } = setUp({ fails: 'EEXIST: file already exists' });
    expect(await act('start')).toEqual(failed('EEXIST: file already exists'));
  });
});
