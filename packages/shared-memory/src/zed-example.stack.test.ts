/** The ZED example against a stand-in for the SDK's Python module, which is as strict as the published interface. */
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { beforeEach, describe, expect, it } from 'vitest';
import { CloudReader } from './cloud/cloud-reader.ts';
import { ReferenceFrameConsumer } from './reference/frame-consumer.ts';
import { MAX_POINTS } from './reference/layout.ts';
import { ADDON_SUITE, EXAMPLES, findPython, roomFor, scratchFolder } from './testing/helpers.ts';

const SIZE = 64;
const python = findPython();
const room = roomFor(MAX_POINTS);
let folder: string;
beforeEach(() => {
  folder = scratchFolder();
});

/** Runs the example until the stand-in's camera is disconnected. */
function run(args: readonly string[] = [], script: Record<string, string> = {}) {
  const command = [join(EXAMPLES, 'zed_camera.py'), '--folder', folder, '--size', String(SIZE)];
  const env = { ...process.env, PYTHONPATH: join(import.meta.dirname, 'testing'), ...script };
  const { status, stderr } = spawnSync(python as string, [...command, '--fps', '1000', ...args], {
    encoding: 'utf8',
    env,
  });
  return { status, said: stderr.trim().split('\n') };
}

const GONE = 'the camera gives no more pictures: CAMERA NOT DETECTED';

describe.skipIf(python === null || ADDON_SUITE.skip)('the ZED’s example (needs numpy and the addon)', () => {
  it('produces clouds in the optical frame with lens, pose and time', () => {
    const { status, said } = run(['--track'], { STANDIN_GRABS: 'SUCCESS,SUCCESS,SUCCESS' });
    expect({ status, said }).toEqual({ status: 1, said: [GONE] });
    using reader = CloudReader.open(folder);
    const frame = reader.read(room);
    expect(frame).toMatchObject({ frame: 3, form: 'images', width: SIZE, height: SIZE });
    const lens = { fx: (1000 * SIZE) / 1920, fy: (1000 * SIZE) / 1080, cx: SIZE / 2, cy: SIZE / 2 };
    for (const [name, value] of Object.entries(lens))
      expect(frame?.lens?.[name as keyof typeof lens]).toBeCloseTo(value, 4);
    const pose = frame?.pose;
    if (pose == null) throw new Error('no pose');
    // The stand-in's camera is 1 m right, 2 m down, 3 m forward of its start.
    expect(pose.position).toEqual({ x: 3, y: -1, z: -2 });
    // Rotated right about its own down axis: in the world, forward and right become axes of that rotation.
    expect(rotate(pose.orientation, [0, 1, 0]).map((v) => v.toFixed(6))).toEqual([
      '0.000000',
      '0.000000',
      '-1.000000',
    ]);
    expect(rotate(pose.orientation, [0, 0, 1]).map((v) => v.toFixed(2))).toEqual(['0.28', '-0.96', '0.00']);
    for (const [column, row] of [
      [0, 0],
      [4, 9],
      [60, 63],
    ] as const) {
      expect(room.depth[row * SIZE + column]).toBe(2);
      expect(room.colour[row * SIZE + column]).toBe((column | (row << 8) | (3 << 16) | (255 << 24)) >>> 0);
    }
    // Unknown, too near, too far: none of them is a position.
    expect([...room.depth.subarray(1, 4)].every((depth) => !(depth > 0 && depth < 100))).toBe(true);
  });

  it('uses the picture’s capture time by the monotonic clock, and adds a pose only on request', () => {
    const before = monotonicMs();
    run();
    const after = monotonicMs();
    using reader = CloudReader.open(folder);
    const frame = reader.read(room);
    expect(frame?.pose).toBeNull();
    expect(frame?.capturedAtMs).toBeGreaterThan(before - 41);
    expect(frame?.capturedAtMs).toBeLessThan(after - 39);
  });

  it('hides pictures of a booting camera and corrupted ones, but shows those with other warnings', () => {
    const grabs = 'CAMERA_REBOOTING,CORRUPTED_FRAME,POTENTIAL_CALIBRATION_ISSUE';
    run([], { STANDIN_GRABS: grabs });
    using reader = CloudReader.open(folder);
    expect(reader.read(room)?.frame).toBe(1);
    expect((room.colour[0] ?? 0) >>> 16).toBe((255 << 8) | 3);
  });

  it('continues if the SDK falls back to another configuration, and reports it', () => {
    const { said } = run([], { STANDIN_OPEN: 'CONFIGURATION_FALLBACK' });
    expect(said).toEqual(['opening the camera: CONFIGURATION FALLBACK', GONE]);
    using reader = CloudReader.open(folder);
    expect(reader.read(room)?.frame).toBe(1);
  });

  it.each([
    [[], { STANDIN_OPEN: 'NO_GPU_COMPATIBLE' }, 'opening the camera: NO GPU COMPATIBLE'],
    [['--track'], { STANDIN_TRACKING: 'FAILURE' }, 'tracking its position: FAILURE'],
    [['--size', '1200'], {}, 'no cloud of 1200 × 1200 to be had: INVALID RESOLUTION'],
  ])('reports what went wrong and ends: %j %j', (args, script, message) => {
    expect(run(args, script as Record<string, string>)).toEqual({ status: 1, said: [message] });
  });

  it('produces the reference’s points', () => {
    run(['--layout', 'reference']);
    using consumer = ReferenceFrameConsumer.open(folder);
    const taken = consumer.take(room.points, { bitsPerSecond: 0, latencyTest: false });
    expect(taken?.points).toBeGreaterThan(0);
    for (let i = 0; i < (taken?.points ?? 0); i++) expect(room.points[i * 4 + 2]).toBe(2);
  });

  it('the stand-in is strict: it fails where the SDK would', () => {
    const refused = [
      ['sl.InitParameters().camera_fsp = 30', 'AttributeError camera_fsp'],
      ['sl.InitParameters().camera_fps = 30.0', 'TypeError 30.0 is no int'],
      ['sl.RuntimeParameters(confidence=1)', 'TypeError unexpected keyword argument confidence'],
      [
        'sl.Camera().grab(sl.RuntimeParameters)',
        "TypeError <class 'pyzed.sl.RuntimeParameters'> is no RuntimeParameters",
      ],
      ['sl.Camera().retrieve_measure(sl.Mat(), sl.MEASURE.XYZRGB)', 'AttributeError XYZRGB'],
      ['sl.Resolution(64, 64, 4)', 'TypeError too many arguments'],
    ] as const;
    const program = `import sys, pyzed.sl as sl
for line in sys.stdin.read().splitlines():
    try:
        exec(line)
        print("taken")
    except Exception as error:
        print(type(error).__name__, error)`;
    const { stdout } = spawnSync(python as string, ['-c', program], {
      encoding: 'utf8',
      env: { ...process.env, PYTHONPATH: join(import.meta.dirname, 'testing') },
      input: refused.map(([line]) => line).join('\n'),
    });
    expect(stdout.trim().split('\n')).toEqual(refused.map(([, answer]) => answer));
  });
});

function monotonicMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}

type Quaternion = { x: number; y: number; z: number; w: number };

/** Rotates a vector by a unit quaternion. */
function rotate({ x, y, z, w }: Quaternion, [a, b, c]: [number, number, number]): number[] {
  const [tx, ty, tz] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}
