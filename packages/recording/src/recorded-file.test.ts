import { describe, expect, it } from 'vitest';
import { RecordedFile } from './recorded-file.ts';
import type { RecorderRequest } from './recorder-messages.ts';

function setUp(path: string | null = null) {
  const posted: RecorderRequest[] = [];
  const file = new RecordedFile(path, (request) => posted.push(request));
  const written = (messages: number, bytes: number) =>
    file.onReport({
      ...{ type: 'written', messages, bytes, faults: 0 },
      dropped: { captured: 0, sent: 0 },
    });
  return { file, posted, written };
}

const opened = (path: string, failed: string | null = null) =>
  ({ type: 'fileOpened', path, failed }) as const;

describe('RecordedFile', () => {
  it('is written from when it is open until it is to be closed, and counts all files', async () => {
    const { file, posted, written } = setUp('a.mcap');
    expect(file.writing).toBe(true);
    written(3, 300);
    const closed = file.close();
    expect(file.writing).toBe(false);
    written(4, 400);
    file.onReport({ type: 'fileClosed' });
    await closed;
    const begun = file.open('b.mcap');
    expect(file.writing).toBe(false);
    file.onReport(opened('b.mcap'));
    await begun;
    expect([file.writing, file.path]).toEqual([true, 'b.mcap']);
    written(1, 50);
    expect([file.messages, file.bytes, file.size]).toEqual([5, 450, 50]);
    expect(posted).toEqual([{ type: 'closeFile' }, { type: 'openFile', path: 'b.mcap' }]);
  });

  it('refuses a second file, one that cannot be created, and any after its thread has ended', async () => {
    const { file } = setUp();
    const first = file.open('a.mcap');
    await expect(file.open('b.mcap')).rejects.toThrow('another file is being written');
    file.onReport(opened('a.mcap', 'EEXIST'));
    await expect(first).rejects.toThrow('EEXIST');
    const again = file.open('c.mcap');
    file.onReport(opened('c.mcap'));
    await again;
    await expect(file.open('d.mcap')).rejects.toThrow('another file is being written');
    file.die();
    expect(file.failed('gone')?.message).toContain('recording stopped: gone');
    await expect(file.open('e.mcap')).rejects.toThrow('nothing can be recorded any more');
  });

  it('tells a failure to whoever closes it, else once', async () => {
    const { file } = setUp('a.mcap');
    const closed = file.close();
    expect(file.failed('disk full')).toBe(null);
    await expect(closed).rejects.toThrow('disk full');
    const { file: other } = setUp('a.mcap');
    expect(other.failed('disk full')?.message).toContain('disk full');
    expect(other.failed('disk full')).toBe(null);
    expect(other.writing).toBe(false);
  });

  it('ends when it is full', () => {
    const { file } = setUp('a.mcap');
    file.onReport({ type: 'full' });
    expect(file.writing).toBe(false);
  });
});
