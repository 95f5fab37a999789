import { describe, expect, it } from 'vitest';
import { PictureLossError } from './picture-maker.ts';
import type { CameraPlan, OfferedPicture, PictureReport, TapReport } from './picture-messages.ts';
import { PictureProcessor } from './picture-processor.ts';

const PLAN: CameraPlan = {
  ...{ perSecond: 5, longestSide: 640, quality: 80, mostFileBytes: 1e6, mostFileSide: 2000 },
};

function setUp(make: () => Uint8Array = () => new Uint8Array(3000)) {
  const toMain: PictureReport[] = [];
  const toTap: TapReport[] = [];
  let cpuMs = 0;
  const processor = new PictureProcessor({
    maker: {
      make: () => {
        cpuMs += 4;
        return { format: 'jpeg', width: 64, height: 48, bytes: make(), untouched: false };
      },
    },
    threadCpu: () => cpuMs,
    tellMain: (report) => toMain.push(report),
    tellTap: (report) => toTap.push(report),
  });
  const offer = (camera: number, missed = 0): OfferedPicture => {
    const facts = { kind: 'file', format: 'jpeg', width: 64, height: 48 } as const;
    const offered = { camera, capturedAtMs: 5000.5, facts, data: new Uint8Array(8), missed };
    processor.onOffered(offered);
    return offered;
  };
  return { processor, offer, toMain, toTap };
}

describe('PictureProcessor', () => {
  it('divides each picture of a watched camera into messages, numbered by camera', () => {
    const { processor, offer, toMain } = setUp();
    processor.onRequest({ type: 'plans', plans: [PLAN, PLAN] });
    offer(0);
    offer(1);
    offer(0);
    const ids = toMain.map((report) => (report.type === 'picture' ? report.header.pictureId : null));
    expect(ids).toEqual([0, 0, 1]);
    expect(toMain[0]).toMatchObject({
      header: { camera: 0, captureTimeUs: 5_000_500, format: 'jpeg' },
      ...{ capturedAtMs: 5000.5, fileBytes: 3000, longestSide: 640, workMs: 4 },
    });
    const chunks = toMain[0]?.type === 'picture' ? toMain[0].chunks : [];
    expect(chunks.length).toBeGreaterThan(1);
    expect(new Set(chunks.map(({ buffer }) => buffer)).size).toBe(1);
  });

  it('tells the capture thread each camera’s rate, and returns every picture’s memory', () => {
    const { processor, offer, toTap, toMain } = setUp();
    processor.onRequest({ type: 'plans', plans: [{ ...PLAN, perSecond: 0 }, PLAN] });
    const [unwatched, unknown] = [offer(0), offer(7)];
    expect(toTap).toEqual([
      { type: 'rates', perSecond: [0, 5] },
      { type: 'done', camera: 0, room: unwatched.data.buffer },
      { type: 'done', camera: 7, room: unknown.data.buffer },
    ]);
    expect(toMain).toEqual([]);
  });

  it('reports pictures that were dropped or cannot be read, and continues', () => {
    let broken = true;
    const { processor, offer, toMain, toTap } = setUp(() => {
      if (broken) throw new PictureLossError('unreadable', 'no end of image');
      return new Uint8Array(10);
    });
    processor.onRequest({ type: 'plans', plans: [PLAN] });
    offer(0, 3);
    broken = false;
    offer(0);
    expect(toMain.slice(0, 2)).toEqual([
      { type: 'lost', camera: 0, reason: 'busy', count: 3, detail: '' },
      { type: 'lost', camera: 0, reason: 'unreadable', count: 1, detail: 'no end of image' },
    ]);
    expect(toMain[2]).toMatchObject({ type: 'picture', header: { pictureId: 0 } });
    expect(toTap.filter(({ type }) => type === 'done')).toHaveLength(2);
  });
});
