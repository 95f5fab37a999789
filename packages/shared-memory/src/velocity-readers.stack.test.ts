/** The C header and the Python module that read velocities, and the examples with a robot's writer that is killed. */
import { type ChildProcess, spawn } from 'node:child_process';
import { once } from 'node:events';
import { chmodSync, chownSync, readFileSync, renameSync, rmSync, truncateSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { type ReferenceFiles, referenceFiles } from './reference/layout.ts';
import {
  ADDON_SUITE,
  compile,
  controlVectors,
  EXAMPLES,
  fromHex,
  runs,
  scratchFolder,
  scratchFolderOfFile,
} from './testing/helpers.ts';

const SILENCE_MS = 200;
const TESTING = join(import.meta.dirname, 'testing');
const STILL = '0 0 0 0 0 0';
const isRoot = process.geteuid?.() === 0;

const built = scratchFolderOfFile();
let folder: string;
let files: ReferenceFiles;
const children: ChildProcess[] = [];
beforeEach(() => {
  folder = scratchFolder();
  files = referenceFiles(folder);
});
afterEach(async () => {
  for (const child of children.splice(0)) await kill(child);
});

async function kill(child: ChildProcess): Promise<void> {
  if (child.exitCode !== null || child.signalCode !== null) return;
  const gone = once(child, 'exit');
  child.kill('SIGKILL');
  await gone;
}

/** A program and its lines. */
function start(command: readonly string[]) {
  const [program, ...args] = command as [string, ...string[]];
  const child = spawn(program, args, { stdio: ['pipe', 'pipe', 'inherit'] });
  children.push(child);
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  return { child, line: async () => ((await lines.next()).value ?? 'it has ended') as string };
}

const compiled = (name: string, program: string, args: readonly string[]) => ({
  name,
  there: runs(program, '--version'),
  reader: () => compile(built, program, args, join(TESTING, 'velocity_reader.c')),
});
const readers = [
  compiled('C99 (gcc)', 'gcc', ['-std=c99', '-ffast-math']),
  compiled('C++ (g++)', 'g++', ['-std=c++11', '-x', 'c++']),
  {
    name: 'Python',
    there: runs('python3', '--version'),
    reader: () => ['python3', join(TESTING, 'velocity_reader.py')],
  },
];

function block(counter: number, x: number): Uint8Array {
  const bytes = new Uint8Array(52);
  const view = new DataView(bytes.buffer);
  view.setInt32(0, counter, true);
  view.setFloat64(4, x, true);
  return bytes;
}

/** In place, as the robot writes it. */
function write(bytes: Uint8Array): void {
  writeFileSync(files.control, bytes, { flag: 'r+' });
}

function make(bytes: Uint8Array): void {
  writeFileSync(files.control, bytes, { mode: 0o600 });
  writeFileSync(files.busy, new Uint8Array(5), { mode: 0o600 });
}

describe.each(readers)('reader in $name', ({ there, reader }) => {
  describe.skipIf(!there)('(needs its compiler, or Python)', () => {
    let command: string[];
    beforeAll(() => {
      command = reader();
    }, 30_000);

    async function open() {
      const { child, line } = start([...command, folder, String(SILENCE_MS)]);
      expect(await line()).toBe('ready');
      const ask = (text: string) => {
        child.stdin?.write(`${text}\n`);
        return line();
      };
      return { read: (nowMs: number) => ask(String(nowMs)), answer: () => ask('answer') };
    }

    /** One that has read 0.5 m/s at 1020 ms, with the counter 2. */
    async function driven() {
      make(block(1, 0.5));
      const reading = await open();
      await reading.read(1000);
      write(block(2, 0.5));
      expect(await reading.read(1020)).toBe('fresh 0.5 0 0 0 0 0');
      return reading;
    }

    it.each(controlVectors())('reads $hex', async ({ counter, linear, angular, hex }) => {
      make(block(counter - 1, 0));
      const { read } = await open();
      await read(1000);
      write(fromHex(hex));
      const [state, ...values] = (await read(1020)).split(' ');
      expect([state, ...values.map(Number)]).toEqual(['fresh', ...linear, ...angular]);
    });

    it('does not believe what it finds at its start: the robot may have died long ago', async () => {
      make(block(7, 0.5));
      const { read, answer } = await open();
      expect(await read(1000)).toBe(`unheard ${STILL}`);
      expect(await answer()).toBe('not told');
      expect(await read(1100)).toBe(`unheard ${STILL}`);
      write(block(8, 0.5));
      expect(await read(1120)).toBe('fresh 0.5 0 0 0 0 0');
    });

    it('is zero after the silence, and moves again when the robot writes again', async () => {
      const { read } = await driven();
      for (const now of [1100, 1200, 1215]) expect(await read(now)).toBe('fresh 0.5 0 0 0 0 0');
      expect(await read(1225)).toBe(`silent ${STILL}`);
      // The same counter with other values is no sign of life.
      write(block(2, 0.7));
      expect(await read(1240)).toBe(`silent ${STILL}`);
      write(block(3, 0.25));
      expect(await read(1260)).toBe('fresh 0.25 0 0 0 0 0');
    });

    it('keeps the last complete velocity while one is written, for no longer than the silence', async () => {
      const { read } = await driven();
      // Killed in the middle of a write.
      writeFileSync(files.busy, Uint8Array.of(1, 0, 0, 0, 0), { flag: 'r+' });
      write(block(3, 9));
      expect(await read(1100)).toBe('fresh 0.5 0 0 0 0 0');
      expect(await read(1225)).toBe(`silent ${STILL}`);
      expect(await read(5000)).toBe(`silent ${STILL}`);
    });

    it('believes nothing that was written while it did not look', async () => {
      const { read } = await driven();
      write(block(3, 0.5));
      expect(await read(2000)).toBe(`unheard ${STILL}`);
      expect(await read(2020)).toBe(`unheard ${STILL}`);
      write(block(4, 0.5));
      expect(await read(2040)).toMatch('fresh');
      expect(await read(3000)).toBe(`silent ${STILL}`);
    });

    it.each([Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY])('is zero for %d', async (x) => {
      const { read } = await driven();
      write(block(3, x));
      expect(await read(1040)).toBe(`invalid ${STILL}`);
      write(block(4, 0.5));
      expect(await read(1060)).toMatch('fresh');
    });

    it('is zero at once when the files are removed, cut short or replaced, and survives that', async () => {
      make(block(1, 0.5));
      const { read, answer } = await open();
      const drive = async (nowMs: number, counter: number) => {
        await read(nowMs);
        write(block(counter, 0.5));
        expect(await read(nowMs + 20)).toMatch('fresh');
      };
      await drive(1000, 2);
      rmSync(files.control);
      expect(await read(1040)).toBe(`absent ${STILL}`);
      make(block(3, 0.5));
      expect(await read(1060)).toBe(`unheard ${STILL}`);
      await drive(1080, 4);
      truncateSync(files.control, 0);
      expect(await read(1120)).toBe(`absent ${STILL}`);
      make(block(5, 0.5));
      await drive(1140, 6);
      truncateSync(files.busy, 1);
      expect(await answer()).toBe('not told');
      expect(await read(1180)).toBe(`absent ${STILL}`);
      make(block(7, 0.5));
      await drive(1200, 8);
      writeFileSync(`${files.control}.new`, block(9, 0.75), { mode: 0o600 });
      renameSync(`${files.control}.new`, files.control);
      expect(await read(1240)).toBe(`unheard ${STILL}`);
    });

    it('waits for files that are not there yet, and refuses those that everybody may write', async () => {
      const { read } = await open();
      expect(await read(1000)).toBe(`absent ${STILL}`);
      make(block(1, 0.5));
      chmodSync(files.control, 0o666);
      expect(await read(1020)).toBe(`absent ${STILL}`);
      chmodSync(files.control, 0o600);
      expect(await read(1040)).toBe(`unheard ${STILL}`);
    });

    it.skipIf(!isRoot)('refuses another user’s files (needs root)', async () => {
      make(block(1, 0.5));
      chownSync(files.control, 54_321, 0);
      const { read } = await open();
      expect(await read(1000)).toBe(`absent ${STILL}`);
    });

    it('answers with the lowest byte of what it has read', async () => {
      make(block(0x1fe, 0));
      const { read, answer } = await open();
      await read(1000);
      write(block(0x1ff, 0));
      await read(1020);
      expect(await answer()).toBe('told');
      expect([...readFileSync(files.busy)]).toEqual([0, 0xff, 0, 0, 0]);
    });

    it.each([1, 99, 5001])('refuses a silence of %d ms', async (silenceMs) => {
      const { line } = start([...command, folder, String(silenceMs)]);
      expect(await line()).toBe('refused');
    });
  });
});

const examples = [
  {
    name: 'wheels.c',
    there: runs('gcc', '--version'),
    command: () => compile(built, 'gcc', ['-std=gnu99'], join(EXAMPLES, 'wheels.c')),
    options: (path: string) => [path, String(SILENCE_MS)],
  },
  {
    name: 'wheels.py',
    there: runs('python3', '--version'),
    command: () => ['python3', join(EXAMPLES, 'wheels.py')],
    options: (path: string) => ['--folder', path, '--silence-ms', String(SILENCE_MS)],
  },
];

describe.each(examples)('the example $name', ({ there, command, options }) => {
  it.skipIf(!there || ADDON_SUITE.skip)('stops when the robot is killed', { timeout: 30_000 }, async () => {
    const { line } = start([...command(), ...options(folder)]);
    expect(await line()).toBe('absent 0.000 m/s 0.000 rad/s');
    const drive = () => start([process.execPath, join(TESTING, 'driving-writer.ts'), '--folder', folder]);
    const until = async (wanted: string) => {
      const passed: string[] = [];
      for (;;) {
        const said = await line();
        if (said === wanted) return passed;
        passed.push(said);
      }
    };
    const writer = drive();
    await until('fresh 0.500 m/s 0.000 rad/s');
    writer.child.kill('SIGKILL');
    await until('silent 0.000 m/s 0.000 rad/s');
    expect(readFileSync(files.control).readDoubleLE(4)).toBe(0.5);
    // The killed one holds no lock, and what it left is not driven.
    drive();
    const passed = await until('fresh 0.500 m/s 0.000 rad/s');
    expect(passed.filter((said) => !said.includes(' 0.000 m/s'))).toEqual([]);
  });
});
