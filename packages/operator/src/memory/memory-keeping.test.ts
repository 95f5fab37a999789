import { describe, expect, test } from 'vitest';
import * as files from './memory-files.ts';
import { MemoryKeeping } from './memory-keeping.ts';
import type { FromMemoryWorker } from './memory-messages.ts';
import { MemoryPages } from './memory-pages.ts';
import { POINT_FILE_FORMATS } from './point-file.ts';
import { cameraAt, frameOfRoom } from './testing/room.ts';
import { TOP_VIEW_BYTES, TopView } from './top-view.ts';

class Port {
  readonly posted: FromMemoryWorker[] = [];
  now = 0;
  /** Whether the code for files cannot be loaded. */
  offline = false;
  withFiles(use: (code: typeof files) => void, failed: () => void): void {
    if (this.offline) failed();
    else use(files);
  }
  post(message: FromMemoryWorker): void {
    this.posted.push(message);
  }
  nowMs(): number {
    return this.now++;
  }
  /** What was posted since the last call. */
  take(): FromMemoryWorker[] {
    return this.posted.splice(0);
  }
}

function look(keeping: MemoryKeeping, frames: number): void {
  for (let i = 0; i < frames; i++)
    keeping.onMessage({ type: 'frame', buffer: frameOfRoom(cameraAt(1, 0, 0), i * 350).buffer });
}

/** A memory that has seen the room. */
function seen(options: Partial<ConstructorParameters<typeof MemoryKeeping>[1]> = {}) {
  const port = new Port();
  const keeping = new MemoryKeeping(port, { pages: 512, ...options });
  look(keeping, 3);
  return { port, keeping };
}

describe('MemoryKeeping', () => {
  test('hands changes on as long as it has buffers, and the rest when one comes back', () => {
    const { port, keeping } = seen();
    for (let i = 0; i < 5; i++) keeping.onMessage({ type: 'resend' });
    const all = port.take();
    const pages = all.filter((message) => message.type === 'pages');
    expect(pages.length).toBe(4);
    expect(all.filter(({ type }) => type === 'taken').length).toBe(3);
    const waiting = keeping.map.store.changedPages;
    expect(waiting).toBeGreaterThan(0);
    const { buffer, count } = pages[0] as FromMemoryWorker & { type: 'pages' };
    expect(new MemoryPages(buffer, count).count).toBe(count);
    keeping.onMessage({ type: 'return', buffer });
    expect(port.take().map(({ type }) => type)).toEqual(['pages']);
    expect(keeping.map.store.changedPages).toBeLessThan(waiting);
  });

  test('says when it has forgotten, also because of a jump', () => {
    const { port, keeping } = seen({ limits: { linear: 1, angular: 1 } });
    port.take();
    keeping.onMessage({ type: 'frame', buffer: frameOfRoom(cameraAt(4.5, 0, 0), 1100).buffer });
    expect(port.take()[0]).toEqual({ type: 'forgotten', jumped: true });
    keeping.onMessage({ type: 'forget' });
    expect(port.take()).toEqual([{ type: 'forgotten', jumped: false }]);
    expect(keeping.map.store.count).toBe(0);
  });

  test('looks from above', () => {
    const { port, keeping } = seen();
    port.take();
    const buffer = new ArrayBuffer(TOP_VIEW_BYTES);
    const area = { x: 3, y: 0, ground: 0, ceiling: 2 };
    keeping.onMessage({ type: 'topView', buffer, area, nowMs: 5000 });
    const [answer] = port.take() as [FromMemoryWorker & { type: 'topView' }];
    expect(answer).toMatchObject({ type: 'topView', buffer });
    expect(answer.oldestS).toBeGreaterThan(4);
    expect(new TopView(answer.buffer).heights.filter((height) => height > 0).length).toBeGreaterThan(300);
  });

  test.each(POINT_FILE_FORMATS)('loads what it has saved as %s, as old as it is', (format) => {
    const { port, keeping } = seen();
    port.take();
    keeping.onMessage({ type: 'save', ticket: 7, nowMs: 5000, savedAt: '2026-01-01T00:00:00Z', format });
    const saved = port.take()[0] as FromMemoryWorker & { type: 'saved' };
    expect(saved.ticket).toBe(7);
    const other = new MemoryKeeping(port, { pages: 512 });
    other.onMessage({ type: 'load', ticket: 8, nowMs: 0, agoS: 60, bytes: saved.bytes });
    const loaded = port.take().find((message) => message.type === 'loaded');
    expect(loaded?.points).toBeGreaterThan(3000);
    // Seen at 0.7 s, saved at 5 s, loaded a minute later, which is when this memory begins.
    const { store } = other.map;
    const page = store.pageChunks.findIndex((chunk) => chunk >= 0);
    expect(24 * 3600 - (store.seen[page * 256] as number) / 16).toBeCloseTo(64.3, 0);
  });

  test('refuses other files', () => {
    const port = new Port();
    const keeping = new MemoryKeeping(port, { pages: 16 });
    const refusal = (text: string) => {
      const bytes = new TextEncoder().encode(text).buffer;
      keeping.onMessage({ type: 'load', ticket: 9, nowMs: 0, agoS: 0, bytes });
      return port.take();
    };
    expect(refusal('solid')).toEqual([{ type: 'refused', ticket: 9, message: 'this is no PLY file' }]);
    expect(refusal('VERSION 0.7\n')).toEqual([
      { type: 'refused', ticket: 9, message: 'PCD, line 2: the header does not end with a DATA line' },
    ]);
  });

  test('says so where the code for files cannot be loaded, and keeps what it has', () => {
    const { port, keeping } = seen();
    port.take();
    port.offline = true;
    const asked = { nowMs: 5000, savedAt: '2026-01-01T00:00:00Z', format: 'ply', agoS: 0 } as const;
    keeping.onMessage({ type: 'save', ticket: 3, ...asked });
    keeping.onMessage({ type: 'load', ticket: 4, ...asked, bytes: new ArrayBuffer(8) });
    const message = 'the code for files could not be loaded: check the network';
    expect(port.take()).toEqual([3, 4].map((ticket) => ({ type: 'refused', ticket, message })));
    expect(keeping.map.store.count).toBeGreaterThan(3000);
  });
});
