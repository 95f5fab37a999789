import { describe, expect, it } from 'vitest';
import { McapFileFull } from './mcap-file-writer.ts';
import { Recorder, type RecorderTarget } from './recorder.ts';
import type { CloudRecord, RecorderReport } from './recorder-messages.ts';

const CLOUD = { type: 'sent' } as CloudRecord;

/** A recorder whose file only records the calls to it; `answer` decides the outcome of each cloud. */
function setUp(answer: (cloud: number) => Promise<void> = async () => undefined, live = false) {
  const done: string[] = [];
  const reports: RecorderReport[] = [];
  const note = (what: string) => async () => void done.push(what);
  let clouds = 0;
  const writer: RecorderTarget = {
    faults: 0,
    dropped: { captured: 1, sent: 2, pictures: 3, videos: 4 },
    addCloud: async () => {
      const cloud = clouds++;
      await answer(cloud);
      done.push(`cloud ${cloud}`);
    },
    addCameras: () => void done.push('cameras'),
    addPicture: note('picture'),
    addVideos: () => void done.push('videos'),
    addVideo: note('video'),
    addTelemetry: () => void done.push('telemetry'),
    addComponents: () => void done.push('components'),
    addEvent: note('event'),
    addOwnState: note('state'),
    openFile: async (path) => {
      if (path === 'full-disk.mcap') throw new Error('no space left on device');
      done.push(`open ${path}`);
      open(true);
    },
    out: {
      ...{ messages: 7, bytes: 900, fileOpen: true, flush: note('flush'), sync: note('sync') },
      get open() {
        return this.fileOpen || live;
      },
      closeFile: async () => {
        if (writer.out.fileOpen) done.push('close');
        open(false);
      },
      abandonFile: () => open(false),
    },
  };
  const open = (isOpen: boolean) => Object.assign(writer.out, { fileOpen: isOpen });
  return { recorder: new Recorder(writer, (report) => reports.push(report)), done, reports };
}

describe('Recorder', () => {
  it('processes requests one after another, however long each takes', async () => {
    const first = Promise.withResolvers<void>();
    const { recorder, done } = setUp((cloud) => (cloud === 0 ? first.promise : Promise.resolve()));
    const clouds = [recorder.addCloud(CLOUD), recorder.addCloud(CLOUD)];
    const closed = recorder.close();
    expect(done).toEqual([]);
    first.resolve();
    await Promise.all([...clouds, closed]);
    expect(done).toEqual(['cloud 0', 'cloud 1', 'state', 'close']);
  });

  it('reports what has been written at each flush, and syncs at every tenth', async () => {
    const { recorder, done, reports } = setUp();
    for (let i = 0; i < 20; i++) await recorder.flush();
    expect(done.filter((what) => what === 'sync')).toHaveLength(2);
    expect(reports).toHaveLength(20);
    expect(reports[0]).toEqual({
      ...{ type: 'written', messages: 7, bytes: 900, faults: 0 },
      dropped: { captured: 1, sent: 2 },
    });
  });

  it('closes a full file and writes nothing after that', async () => {
    const { recorder, done, reports } = setUp(async (cloud) => {
      if (cloud === 1) throw new McapFileFull();
    });
    for (let i = 0; i < 3; i++) await recorder.addCloud(CLOUD);
    await recorder.flush();
    expect(recorder.fileOpen).toBe(false);
    expect(done).toEqual(['cloud 0', 'close']);
    expect(reports.map(({ type }) => type)).toEqual(['written', 'full']);
  });

  it('reports a failure once, and still returns the memory of clouds', async () => {
    const { recorder, done, reports } = setUp(async () => {
      throw new Error('no space left on device');
    });
    await recorder.addCloud(CLOUD);
    await recorder.addCloud(CLOUD);
    expect(done).toEqual([]);
    expect(reports).toEqual([{ type: 'failed', detail: 'no space left on device' }]);
  });

  it('goes on for live viewers when the file is full', async () => {
    const { recorder, done } = setUp(async (cloud) => {
      if (cloud === 1) throw new McapFileFull();
    }, true);
    for (let i = 0; i < 3; i++) await recorder.addCloud(CLOUD);
    expect(done).toEqual(['cloud 0', 'close', 'cloud 2']);
  });

  it('begins a file after one that ended, in its turn, and refuses one while another is open', async () => {
    const { recorder, done, reports } = setUp();
    recorder.onRequest({ type: 'openFile', path: 'b.mcap' });
    recorder.onRequest({ type: 'closeFile' });
    recorder.onRequest({ type: 'openFile', path: 'b.mcap' });
    await recorder.addCloud(CLOUD);
    expect(done).toEqual(['state', 'close', 'open b.mcap', 'cloud 0']);
    expect(reports.filter(({ type }) => type !== 'written')).toEqual([
      { type: 'fileOpened', path: 'b.mcap', failed: 'another file is being written' },
      { type: 'fileClosed' },
      { type: 'fileOpened', path: 'b.mcap', failed: null },
    ]);
  });

  it('says why a file cannot be begun, and begins another', async () => {
    const { recorder, done, reports } = setUp();
    await recorder.close();
    recorder.onRequest({ type: 'openFile', path: 'full-disk.mcap' });
    recorder.onRequest({ type: 'openFile', path: 'b.mcap' });
    await recorder.addCloud(CLOUD);
    expect(done.slice(2)).toEqual(['open b.mcap', 'cloud 0']);
    expect(reports.slice(1)).toEqual([
      { type: 'fileOpened', path: 'full-disk.mcap', failed: 'no space left on device' },
      { type: 'fileOpened', path: 'b.mcap', failed: null },
    ]);
  });
});
