import { readFileSync, rmSync, statSync, truncateSync, writeFileSync } from 'node:fs';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import { eventually } from '@farpoint/service/testing/eventually';
import fc from 'fast-check';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { ADDON_SUITE, controlVectors, errorOf, fromHex, scratchFolder, toHex } from '../testing/helpers.ts';
import { ReferenceControlReader } from './control-reader.ts';
import { ReferenceControlWriter } from './control-writer.ts';
import { type ReferenceFiles, referenceFiles } from './layout.ts';

let folder: string;
let files: ReferenceFiles;
const open: Disposable[] = [];
beforeEach(() => {
  folder = scratchFolder();
  files = referenceFiles(folder);
});
afterEach(() => {
  for (const each of open.splice(0)) each[Symbol.dispose]();
});

/** Only the test about this silence waits for it. */
function writer(silenceMs = 60_000): ReferenceControlWriter {
  const made = new ReferenceControlWriter({ folder, silenceMs });
  open.push(made);
  return made;
}

function reader(): ReferenceControlReader {
  const made = new ReferenceControlReader(folder);
  open.push(made);
  return made;
}

const twistOf = ([x, y, z]: number[], [ax, ay, az]: number[]): Twist =>
  ({ linear: { x, y, z }, angular: { x: ax, y: ay, z: az } }) as Twist;
const forward = twistOf([0.5, 0, 0], [0, 0, 0.1]);

describe.skipIf(ADDON_SUITE.skip)(`command block (${ADDON_SUITE.note})`, () => {
  it('creates the files correctly, for their owner', () => {
    writer();
    expect(statSync(files.control)).toMatchObject({ size: 52 });
    expect(statSync(files.busy)).toMatchObject({ size: 5 });
    expect(statSync(files.control).mode & 0o777).toBe(0o600);
  });

  it.each(controlVectors())('reads and writes $hex', ({ counter, linear, angular, hex }) => {
    const before = new Uint8Array(52);
    new DataView(before.buffer).setInt32(0, counter - 1, true);
    writeFileSync(files.control, before, { mode: 0o600 });
    expect(writer().write(twistOf(linear, angular))).toBe(counter);
    expect(toHex(readFileSync(files.control))).toBe(hex);
    expect(readFileSync(files.busy)[0]).toBe(0);
    writeFileSync(files.control, fromHex(hex));
    expect(reader().read()).toEqual({ counter, twist: twistOf(linear, angular) });
  });

  it('carries the reader’s answer in a byte that writing leaves alone', () => {
    const write = writer();
    expect(write.readerEcho()).toBe(0);
    const read = new ReferenceControlReader(folder, { answers: true });
    open.push(read);
    read.answer(0x1ff);
    write.write(forward);
    expect(write.readerEcho()).toBe(0xff);
    expect([...readFileSync(files.busy)]).toEqual([0, 0xff, 0, 0, 0]);
  });

  it('carries any velocity, its counter growing by one', () => {
    const value = fc.double({ noNaN: true, noDefaultInfinity: true });
    const [write, read] = [writer(), reader()];
    let last = 0;
    fc.assert(
      fc.property(fc.array(value, { minLength: 6, maxLength: 6 }), (v) => {
        const twist = twistOf(v.slice(0, 3), v.slice(3));
        const counter = write.write(twist);
        expect(counter).toBe(last + 1);
        last = counter;
        expect(read.read()).toEqual({ counter, twist });
      }),
      { numRuns: 100, seed: 1 },
    );
  });

  it('is not read while it is written, and refuses a velocity that is not finite', () => {
    writer().write(forward);
    const read = reader();
    writeFileSync(files.busy, Uint8Array.of(1, 0, 0, 0, 0));
    expect(read.read()).toBeNull();
    writeFileSync(files.busy, Uint8Array.of(0, 0, 0, 0, 0));
    const bytes = readFileSync(files.control);
    bytes.writeDoubleLE(Number.NaN, 12);
    writeFileSync(files.control, bytes);
    expect(errorOf(() => read.read())).toMatchObject({ code: 'bad-frame', file: files.control, offset: 12 });
  });

  it('clears a busy flag that a killed writer left', () => {
    const first = writer();
    first.write(forward);
    first.close();
    writeFileSync(files.busy, Uint8Array.of(1, 0, 0, 0, 0));
    writer().write(zeroTwist());
    expect(reader().read()?.twist).toEqual(zeroTwist());
  });

  it('becomes zero by itself if nothing is written, and its counter shows this', async () => {
    const write = writer(5);
    const read = reader();
    const counter = write.write(forward);
    // Nothing in this thread writes.
    await eventually(() => (read.read()?.counter ?? counter) > counter);
    expect(read.read()).toEqual({ counter: counter + 1, twist: zeroTwist() });
    expect(write.silences).toBe(1);
    expect(write.write(zeroTwist())).toBe(counter + 2);
  });

  it('becomes zero even while this thread is blocked', () => {
    const write = writer(5);
    const read = reader();
    const counter = write.write(forward);
    const deadline = performance.now() + 10_000;
    while ((read.read()?.counter ?? counter) === counter && performance.now() < deadline);
    expect(read.read()?.twist).toEqual(zeroTwist());
  });

  it('becomes zero when it is closed', () => {
    const write = writer();
    const counter = write.write(forward);
    const read = reader();
    write.close();
    expect(read.read()).toEqual({ counter: counter + 1, twist: zeroTwist() });
  });

  it('continues if the reader recreates the files, or truncates and restores them', () => {
    const write = writer();
    const counter = write.write(forward);
    truncateSync(files.control, 0);
    truncateSync(files.busy, 0);
    expect(write.write(forward)).toBeGreaterThan(0);
    expect(reader().read()?.twist).toEqual(forward);
    rmSync(files.control);
    rmSync(files.busy);
    expect(write.write(forward)).toBeGreaterThan(0);
    expect(reader().read()?.twist).toEqual(forward);
    expect(counter).toBe(1);
  });

  it('refuses a second writer, which writes nothing, and names the first one and the remedy', () => {
    const first = writer();
    first.write(forward);
    const before = toHex(readFileSync(files.control));
    const error = errorOf(() => writer());
    expect(error).toMatchObject({ code: 'in-use', file: files.control, holder: process.pid });
    expect(error.message).toContain(`(process ${process.pid}) writes it: end that program`);
    expect(error.message).toContain('--shm-folder');
    expect(toHex(readFileSync(files.control))).toBe(before);
    // Readers need no lock.
    expect(reader().read()?.twist).toEqual(forward);
    first.close();
    expect(writer().write(zeroTwist())).toBe(3);
  });

  it('a writer whose file was recreated and is written by another writes no more', () => {
    const first = writer();
    first.write(forward);
    rmSync(files.control);
    const second = writer();
    second.write(zeroTwist());
    expect(errorOf(() => first.write(forward)).code).toBe('in-use');
    expect(errorOf(() => first.write(forward)).code).toBe('in-use');
    expect(reader().read()?.twist).toEqual(zeroTwist());
    second.close();
    first.write(forward);
    expect(reader().read()?.twist).toEqual(forward);
  });

  it('says which file is unavailable', () => {
    rmSync(folder, { recursive: true });
    expect(errorOf(() => writer())).toMatchObject({ code: 'absent', file: files.control });
  });
});
