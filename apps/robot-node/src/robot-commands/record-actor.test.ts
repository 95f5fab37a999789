import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import type { ActionResult } from './command-actor.ts';
import type { RecordAction } from './command-configuration.ts';
import { RecordActor, type RecordControl } from './record-actor.ts';
import { recordingName } from './recording-name.ts';

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
    ...{ robotId: 'robot 1', folder: { path: folder, mostBytes }, path: own, bookmarks: [] },
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
    bookmark(text) {
      this.bookmarks.push(text);
    },
  };
  return { recording, act: actOf(new RecordActor(recording, () => NOW)) };
}

function actOf(actor: RecordActor) {
  return (action: RecordAction) =>
    new Promise<ActionResult>((resolve) => actor.act({ kind: 'record', action }, 1000, resolve, 'Ann'));
}

describe('RecordActor', () => {
  it('begins a recording in the folder, marks instants in it, and ends it', async () => {
    const { recording, act } = setUp();
    expect(await act('start')).toEqual({ done: true, detail: 'robot_1-20261127T093501Z.mcap' });
    expect(recording.path).toBe(join(folder, 'robot_1-20261127T093501Z.mcap'));
    expect(await act('start')).toEqual({ done: false, detail: 'the session is being recorded already' });
    expect(await act('bookmark')).toEqual({ done: true, detail: 'number 1' });
    expect(await act('bookmark')).toEqual({ done: true, detail: 'number 2' });
    expect(recording.bookmarks).toEqual(['1, by Ann', '2, by Ann']);
    expect(await act('stop')).toEqual({ done: true, detail: 'robot_1-20261127T093501Z.mcap is complete' });
    expect(await act('stop')).toEqual({ done: false, detail: 'nothing is being recorded' });
    expect(await act('bookmark')).toEqual({ done: false, detail: 'nothing is being recorded' });
  });

  it('marks instants in the robot’s own recording, and never ends it', async () => {
    const { recording, act } = setUp({ own: '/data/own.mcap' });
    expect(await act('bookmark')).toMatchObject({ done: true });
    expect(await act('stop')).toEqual({ done: false, detail: 'the robot itself records, until it ends' });
    expect(recording.path).toBe('/data/own.mcap');
  });

  it('begins none where the folder is full or missing, or nothing can be recorded', async () => {
    writeFileSync(join(folder, 'old.mcap'), new Uint8Array(600));
    writeFileSync(join(folder, 'other.txt'), new Uint8Array(5000));
    expect(await setUp({ mostBytes: 601 }).act('start')).toMatchObject({ done: true });
    const full = { done: false, detail: 'the folder has no more room for recordings' };
    expect(await setUp({ mostBytes: 600 }).act('start')).toEqual(full);
    const { recording, act } = setUp();
    Object.assign(recording, { folder: { path: join(folder, 'missing'), mostBytes: 1 } });
    expect(await act('start')).toEqual({ done: false, detail: 'the folder for recordings cannot be read' });
    Object.assign(recording, { folder: null });
    expect(await act('start')).toMatchObject({ done: false });
    const none = actOf(new RecordActor(null));
    expect(await none('bookmark')).toEqual({ done: false, detail: 'nothing can be recorded here' });
  });

  it('says why a file cannot be created', async () => {
    const { act } = setUp({ fails: 'EEXIST: file already exists' });
    expect(await act('start')).toEqual({ done: false, detail: 'EEXIST: file already exists' });
  });
});

describe('recordingName', () => {
  it('sorts by time, and has no character that a file system minds', () => {
    const names = ['2026-11-27T09:35:01Z', '2026-11-27T10:00:00Z', '2027-01-01T00:00:00Z'].map((time) =>
      recordingName('a/b:c', new Date(time)),
    );
    expect(names.toSorted()).toEqual(names);
    for (const name of names) expect(name).toMatch(/^a_b_c-\d{8}T\d{6}Z\.mcap$/);
  });
});
