/** The C header and the Python module as producers, read by the robot's reader; and the examples as programs. */
import { spawnSync } from 'node:child_process';
import { readdirSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { packColour664, quantiseMillimetres } from '@farpoint/protocol';
import { beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { CloudReader } from './cloud/cloud-reader.ts';
import { cloudFile } from './cloud/layout.ts';
import { ReferenceFrameConsumer } from './reference/frame-consumer.ts';
import { MAX_POINTS, referenceFiles } from './reference/layout.ts';
import {
  ADDON_SUITE,
  compile,
  EXAMPLES,
  findPython,
  roomFor,
  runs,
  scratchFolder,
  scratchFolderOfFile,
  toHex,
} from './testing/helpers.ts';

const SOURCE = join(import.meta.dirname, 'testing', 'producer.c');
const CAMERA = join(EXAMPLES, 'synthetic_camera.py');
const COMPILERS = {
  'C (gcc)': { program: 'gcc', args: ['-std=c11'] },
  'C++ (g++)': { program: 'g++', args: ['-std=c++17', '-x', 'c++'] },
};

const built = scratchFolderOfFile();
let folder: string;
const python = findPython();
beforeEach(() => {
  folder = scratchFolder();
});

function run(command: readonly string[], input = ''): string {
  const [program, ...args] = command as [string, ...string[]];
  const { status, stdout, stderr } = spawnSync(program, args, { encoding: 'utf8', input });
  if (status !== 0) throw new Error(`${command.join(' ')}: ${stderr}`);
  return stdout;
}

const producers = [
  ...Object.entries(COMPILERS).map(([name, { program, args }]) => ({
    name,
    there: runs(program, '--version'),
    command: () => compile(built, program, args, SOURCE),
  })),
  {
    name: 'Python',
    there: python !== null,
    command: () => [python as string, join(import.meta.dirname, 'testing', 'producer.py')],
  },
];

const room = roomFor(MAX_POINTS);
const header = {
  ...{ frame: 6, points: 12, capturedAtMs: 123.456789, width: 4, height: 3, latencyTest: true },
  pose: { position: { x: 1.5, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
};
const lens = { fx: 2, fy: 2, cx: 1, cy: 1 };
const colourAt = (i: number) => [i, i + 1, i + 2, 255];

describe.each(producers)('producer in $name', ({ there, command }) => {
  describe.skipIf(!there || ADDON_SUITE.skip)('(needs its compiler or numpy, and the addon)', () => {
    let program: string[];
    beforeAll(() => {
      program = command();
    }, 30_000);

    it('writes points that the robot reads', () => {
      run([...program, folder, 'points']);
      using reader = CloudReader.open(folder);
      expect(statSync(cloudFile(folder)).mode & 0o777).toBe(0o660);
      expect(readdirSync(folder)).toEqual(['farpoint_cloud']);
      expect(reader.header).toMatchObject({ format: 'points', slots: 4, maxPoints: 12, framesPerSecond: 30 });
      expect(reader.read(room)).toEqual({ ...header, form: 'points', lens: null, depthUnit: 0 });
      const bytes = new Uint8Array(room.points.buffer);
      for (let i = 0; i < 12; i++) {
        expect([...room.points.subarray(i * 4, i * 4 + 3)]).toEqual([i + 6, i + 6, i + 6]);
        expect([...bytes.subarray(i * 16 + 12, i * 16 + 16)]).toEqual(colourAt(i));
      }
    });

    it.each(['depth16', 'depth32'])('writes %s that the robot reads', (format) => {
      run([...program, folder, format]);
      using reader = CloudReader.open(folder);
      expect(reader.read(room)).toMatchObject({ ...header, form: 'images', lens });
      const bytes = new Uint8Array(room.colour.buffer);
      for (let i = 0; i < 12; i++) {
        expect(room.depth[i]).toBeCloseTo(i + 6, 5);
        expect([...bytes.subarray(i * 4, i * 4 + 4)]).toEqual(colourAt(i));
      }
    });

    it('refuses invalid arguments, a second producer, and to keep writing in vain', () => {
      // It ends with another status if one of them is accepted.
      expect(() => run([...program, folder, 'refusals'])).not.toThrow();
    });

    it('continues over what a killed producer left', () => {
      writeFileSync(cloudFile(folder), 'half');
      writeFileSync(`${cloudFile(folder)}.new`, 'half');
      run([...program, folder, 'points']);
      using reader = CloudReader.open(folder);
      expect(reader.read(room)?.frame).toBe(6);
    });

    it('writes the reference layout, and reads the robot’s requests', () => {
      const files = referenceFiles(folder);
      writeFileSync(files.flags, Uint8Array.of(0, 1, 0x80, 0xc3, 0xc9, 0x01), { mode: 0o600 });
      expect(run([...program, folder, 'reference']).trim()).toBe('30000000 1');
      using consumer = ReferenceFrameConsumer.open(folder);
      expect(statSync(files.cloud).mode & 0o777).toBe(0o600);
      expect(consumer.take(room.points, { bitsPerSecond: 0, latencyTest: false })).toEqual({
        points: 151,
        green: false,
      });
      expect(room.points[0]).toBe(Math.fround(0.257));
    });
  });
});

describe.skipIf(python === null || ADDON_SUITE.skip)('Python packing (needs numpy and the addon)', () => {
  it('produces the packets’ blocks, without points that cannot be sent', () => {
    const points = Array.from({ length: 320 }, (_, i) => [
      ...[Math.fround((i - 100) * 0.0123), Math.fround(i * 0.0005), Math.fround(1 + i * 0.03)],
      ...[i % 256, (i * 7) % 256, (i * 13) % 256],
    ]);
    const bad = [
      [null, 0, 1, 0, 0, 0],
      [0, 0, -1, 0, 0, 0],
      [33, 0, 1, 0, 0, 0],
    ];
    const program = [python as string, join(import.meta.dirname, 'testing', 'producer.py'), folder, 'pack'];
    const answer = JSON.parse(run(program, JSON.stringify([...points, ...bad]))) as Record<string, unknown>;
    const blocks = (latencyTest: boolean) => {
      const bytes = new Uint8Array(320 * 8);
      const view = new DataView(bytes.buffer);
      for (let i = 0; i < 320; i++) {
        const first = Math.floor(i / 150) * 150;
        const count = Math.min(150, 320 - first);
        const [x = 0, y = 0, z = 0, r = 0, g = 0, b = 0] = points[i] as number[];
        for (const [axis, metres] of [x, y, z].entries())
          view.setInt16(first * 8 + (i - first) * 6 + axis * 2, quantiseMillimetres(metres), true);
        const colour = latencyTest ? 0x03f0 : packColour664(r, g, b);
        view.setUint16(first * 8 + count * 6 + (i - first) * 2, colour, true);
      }
      return toHex(bytes);
    };
    expect(answer).toEqual({ hex: blocks(false), green: blocks(true), drawn: 300 });
  });
});

describe.skipIf(python === null || ADDON_SUITE.skip)('examples (need numpy and the addon)', () => {
  const synthetic = (...args: string[]) =>
    run([python as string, CAMERA, '--folder', folder, '--size', '64', ...args]);

  it.each(['points', 'depth16', 'depth32'])('the synthetic camera produces %s', (format) => {
    synthetic('--frames', '3', '--fps', '1000', '--format', format);
    using reader = CloudReader.open(folder);
    expect(reader.read(room)).toMatchObject({ frame: 3, form: 'images', width: 64, height: 64 });
    const depths = room.depth.subarray(0, 64 * 64);
    expect(Math.max(...depths)).toBeCloseTo(4, 2);
    expect(Math.min(...depths)).toBeGreaterThan(0.5);
  });

  it('the synthetic camera produces the reference’s points', () => {
    synthetic('--frames', '1', '--layout', 'reference');
    using consumer = ReferenceFrameConsumer.open(folder);
    const frame = consumer.take(room.points, { bitsPerSecond: 0, latencyTest: false });
    // In whole packets, as in the paper's equation 3.
    expect(frame?.points).toBe(27 * 150);
    for (let i = 0; i < 27 * 150; i++) expect(room.points[i * 4 + 2]).toBeLessThanOrEqual(4.001);
  });

  it('the ZED example says what is missing', () => {
    const zed = join(EXAMPLES, 'zed_camera.py');
    run([python as string, '-m', 'py_compile', zed]);
    if (runs(python as string, '-c', 'import pyzed.sl')) return;
    const { status, stderr } = spawnSync(python as string, [zed, '--folder', folder], { encoding: 'utf8' });
    expect(status).toBe(1);
    expect(stderr.trim()).toMatch(/^pyzed is missing: install the ZED SDK .*$/);
  });
});
