import { chmodSync, readFileSync, rmSync, statSync, truncateSync, writeFileSync } from 'node:fs';
import fc from 'fast-check';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { MappedFile } from '../mapped-file.ts';
import { ADDON_SUITE, codeOf, errorOf, roomFor, scratchFolder } from '../testing/helpers.ts';
import { Watch } from '../watch.ts';
import { CloudProducer } from './cloud-producer.ts';
import { CloudReader } from './cloud-reader.ts';
import { cloudFile, PUBLISHED_OFFSET } from './layout.ts';

let folder: string;
let path: string;
const open: Disposable[] = [];
beforeEach(() => {
  folder = scratchFolder();
  path = cloudFile(folder);
});
afterEach(() => {
  for (const each of open.splice(0)) each[Symbol.dispose]();
});

function keep<T extends Disposable>(made: T): T {
  open.push(made);
  return made;
}
const producer = (maxPoints = 100) => keep(new CloudProducer({ folder, format: 'points', maxPoints }));
const reader = () => keep(CloudReader.open(folder));

const FRAME = { capturedAtMs: null, height: 1, pose: null, lens: null, latencyTest: false };
const room = roomFor(100);
const words = new Uint32Array(room.points.buffer);

function publish(to: CloudProducer, value: number, points = 100): void {
  to.publish({ points: new Uint32Array(points * 4).fill(value) }, { ...FRAME, width: points });
}

describe.skipIf(ADDON_SUITE.skip)(`cloud ring (${ADDON_SUITE.note})`, () => {
  it('returns the newest frame once, with all its metadata', () => {
    const [write, read] = [producer(), reader()];
    expect(read.read(room)).toBeNull();
    for (let i = 1; i <= 6; i++) publish(write, i);
    const pose = { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
    const header = { capturedAtMs: 12.5, width: 4, height: 3, pose, lens: null, latencyTest: true };
    write.publish({ points: new Uint32Array(48).fill(0x7fc00001) }, header);
    expect(read.read(room)).toEqual({ frame: 7, form: 'points', points: 12, ...header, depthUnit: 0 });
    // Bit for bit, including NaNs.
    expect(words.subarray(0, 48).every((word) => word === 0x7fc00001)).toBe(true);
    expect(read.read(room)).toBeNull();
    expect(read.skipped).toBe(0);
    for (let i = 0; i < 3; i++) publish(write, i);
    expect(read.read(room)?.frame).toBe(10);
    expect(read.skipped).toBe(2);
  });

  it('returns a camera’s frames as images, whatever their format', () => {
    const lens = { fx: 2, fy: 4, cx: 1, cy: 0.5 };
    const metres = [1, 0, 2.5, 65.535, 0.001, 0.5].map(Math.fround);
    const colours = new Uint8Array(24).map((_, i) => i * 10);
    const contents = {
      depth16: { depth: Uint16Array.from(metres, (value) => Math.round(value * 1000)), colours },
      depth32: { depth: Float32Array.from(metres), colours },
      points: { points: new Float32Array(24) },
    };
    const bytes = new Uint8Array(contents.points.points.buffer);
    metres.forEach((value, i) => {
      contents.points.points.set([-1, -1, value], i * 4);
      bytes.set(colours.subarray(i * 4, i * 4 + 4), i * 16 + 12);
    });
    for (const format of ['depth16', 'depth32', 'points'] as const) {
      const write = keep(new CloudProducer({ folder, format, maxPoints: 6 }));
      write.publish(contents[format], { ...FRAME, width: 3, height: 2, lens, depthUnit: 0.001 });
      room.depth.fill(7);
      room.colour.fill(7);
      expect(reader().read(room)).toMatchObject({ form: 'images', points: 6, width: 3, height: 2, lens });
      metres.forEach((value, i) => {
        expect(room.depth[i]).toBeCloseTo(value, 5);
      });
      expect([...new Uint8Array(room.colour.buffer, 0, 24)]).toEqual([...colours]);
      expect([room.depth[6], room.colour[6]]).toEqual([7, 7]);
      write.close();
    }
  });

  it('reads no frame that is being written, nor one that a killed producer has left unfinished', () => {
    const [write, read] = [producer(), reader()];
    publish(write, 1);
    expect(read.read(room)?.frame).toBe(1);
    using other = MappedFile.open(path, { writable: true });
    const slot = 4096 + 2 * write.header.slotBytes;
    other.store32(slot, 3);
    expect(read.read(room)).toBeNull();
    // Published although the slot was not finished: treated as never published.
    other.store32(PUBLISHED_OFFSET, 2);
    expect(read.read(room)).toBeNull();
    expect(read.overtaken).toBe(8);
    publish(write, 2);
    expect(read.read(room)?.frame).toBe(2);
  });

  it('reports an impossible published frame as such, once', () => {
    const [write, read] = [producer(), reader()];
    publish(write, 1);
    using other = MappedFile.open(path, { writable: true });
    const slot = 4096 + write.header.slotBytes;
    other.store32(slot + 16, 0xffffffff);
    expect(errorOf(() => read.read(room))).toMatchObject({
      code: 'bad-frame',
      file: path,
      offset: slot + 16,
    });
    expect(read.read(room)).toBeNull();
    publish(write, 2);
    expect(read.read(room)?.frame).toBe(2);
    publish(write, 3);
    expect(codeOf(() => read.read({ ...room, points: room.points.subarray(0, 399) }))).toBe('too-large');
  });

  it('survives any bytes written into it', () => {
    const [write, read] = [producer(20), reader()];
    using other = MappedFile.open(path, { writable: true });
    const { slotBytes } = write.header;
    const edit = fc.tuple(fc.nat({ max: 32 }), fc.nat({ max: 0xffffffff }));
    fc.assert(
      fc.property(fc.array(edit, { minLength: 1, maxLength: 5 }), (edits) => {
        publish(write, 1, 20);
        const slot = 4096 + (other.load32(PUBLISHED_OFFSET) % 4) * slotBytes;
        for (const [index, value] of edits) other.store32(slot + (index % 32) * 4, value);
        try {
          const frame = read.read(room);
          expect(frame?.points ?? 0).toBeLessThanOrEqual(20);
        } catch (error) {
          expect(error).toMatchObject({ name: 'SharedMemoryError', code: 'bad-frame' });
        }
      }),
      { numRuns: 300, seed: 3 },
    );
  });

  it('has one producer; the next takes over once that is gone, and readers notice', () => {
    const first = producer();
    publish(first, 1);
    const read = reader();
    expect(codeOf(() => producer())).toBe('in-use');
    first.close();
    const second = producer(50);
    expect(read.current).toBe(false);
    publish(second, 9, 50);
    expect(reader().read(room)).toMatchObject({ frame: 1, points: 50 });
    expect(words[0]).toBe(9);
    // The mapping stays readable.
    expect(read.read(room)?.points).toBe(100);
  });

  it('starts over what a producer left that was killed while it started, or what is no such file', () => {
    writeFileSync(path, 'something else');
    writeFileSync(`${path}.new`, 'half a header');
    publish(producer(), 3);
    expect(reader().read(room)?.frame).toBe(1);
    expect(statSync(path).mode & 0o777).toBe(0o600);
  });

  it('a producer whose file was removed does not keep writing to it', () => {
    const write = producer();
    rmSync(path);
    expect(codeOf(() => publish(write, 1))).toBe('in-use');
  });

  it('refuses files that are missing, truncated, too long, of another kind or open to everybody', () => {
    expect(errorOf(() => reader())).toMatchObject({ code: 'absent', file: path });
    producer();
    const whole = readFileSync(path);
    truncateSync(path, whole.length + 1);
    expect(codeOf(() => reader())).toBe('bad-header');
    truncateSync(path, 100);
    expect(codeOf(() => reader())).toBe('truncated');
    writeFileSync(path, new Uint8Array(whole.length));
    expect(codeOf(() => reader())).toBe('bad-magic');
    chmodSync(path, 0o602);
    expect(codeOf(() => reader())).toBe('unsafe-permissions');
  });

  it('survives truncation while it is read', () => {
    const [write, read] = [producer(), reader()];
    publish(write, 1);
    truncateSync(path, 4096);
    expect(errorOf(() => read.read(room))).toMatchObject({ code: 'truncated', file: path });
    expect(read.current).toBe(false);
    expect(codeOf(() => publish(write, 2))).toBe('in-use');
  });

  it('refuses content that does not fit', () => {
    const write = producer();
    expect(() => write.publish({ points: new Uint32Array(404) }, { ...FRAME, width: 100 })).toThrow(
      RangeError,
    );
    expect(codeOf(() => write.publish({ points: new Uint32Array(404) }, { ...FRAME, width: 101 }))).toBe(
      'bad-frame',
    );
    expect(codeOf(() => new CloudProducer({ folder, format: 'points', maxPoints: 0 }))).toBe('bad-header');
  });

  it('wakes waiting readers when a frame is published', async () => {
    const [write, read] = [producer(), reader()];
    const outcome = await new Promise((resolve) => {
      const watch = keep(new Watch(read.file, { offset: PUBLISHED_OFFSET, futex: true }, resolve));
      watch.arm({ value: read.last, timeoutMs: 60_000 });
      setImmediate(() => publish(write, 5));
    });
    expect(outcome).toBe('changed');
    expect(read.read(room)?.frame).toBe(1);
  });
});
