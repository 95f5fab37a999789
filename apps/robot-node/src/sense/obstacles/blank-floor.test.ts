import { rotate } from '@farpoint/protocol';
import { floorClasses } from '@farpoint/safety';
import { describe, expect, test } from 'vitest';
import { opticalMount } from '../sources/sensor-mount.ts';
import { BlankFloor } from './blank-floor.ts';

const SHAPE = { side: 160, cellM: 0.05 };
const SIZE = 160;
const CAMERA = { width: SIZE, height: SIZE, fx: 80, fy: 80, cx: 79.5, cy: 79.5 };
const MOUNT = opticalMount({ x: 0.12, y: 0, z: 0.9, roll: 0, pitch: 0.4, yaw: 0 });
const HERE = { x: 0, y: 0, yaw: 0 };
const { unknown, free, occupied, dropOff } = floorClasses;

const cellOf = (x: number, y: number) => Math.floor(y / 0.05 + 80) * 160 + Math.floor(x / 0.05 + 80);

type Seen = 'floor' | 'nothing' | 'thing';

/** What the camera of a robot at the origin gives of a floor, and the grid of it. */
function look(seen: (x: number, y: number) => Seen, column: (u: number) => boolean = () => true) {
  const depth = new Float32Array(SIZE * SIZE);
  const classes = new Uint8Array(160 * 160);
  for (let v = 0; v < SIZE; v++) {
    for (let u = 0; u < SIZE; u++) {
      const ray = rotate(MOUNT.orientation, { x: (u - 79.5) / 80, y: (v - 79.5) / 80, z: 1 });
      const along = ray.z < 0 ? MOUNT.position.z / -ray.z : 9;
      const [x, y] = [MOUNT.position.x + along * ray.x, along * ray.y];
      const what = ray.z < 0 ? seen(x, y) : 'thing';
      if (what === 'nothing' || !column(u)) continue;
      depth[v * SIZE + u] = along;
      if (Math.hypot(x, y) < 3.5) classes[cellOf(x, y)] = what === 'floor' ? free : occupied;
    }
  }
  return { depth, classes };
}

function marked({ depth, classes }: ReturnType<typeof look>, pose = HERE): Uint8Array {
  new BlankFloor(CAMERA, MOUNT, SHAPE).mark(depth, pose, classes);
  return classes;
}

const within = (x: number, y: number, fromX: number, toX: number) =>
  x > fromX && x < toX && Math.abs(y) < 0.3;

describe('floor that a camera should see', () => {
  test('is missing where it gives nothing behind floor that it does give', () => {
    const classes = marked(look((x, y) => (within(x, y, 1, 1.6) ? 'nothing' : 'floor')));
    for (const x of [1.08, 1.3, 1.52]) expect(classes[cellOf(x, 0.02)]).toBe(dropOff);
    expect(classes[cellOf(0.9, 0.02)]).toBe(free);
    expect(classes[cellOf(1.3, 0.5)]).toBe(free);
    // The whole of it: its edges are cells of which some is floor.
    const count = classes.filter((known) => known === dropOff).length;
    expect(count).toBeGreaterThan(0.75 * 12 * 12);
  });

  test('is only unseen beyond what it sees, in small spots, and behind an obstacle', () => {
    const none = (classes: Uint8Array) => expect(classes.includes(dropOff)).toBe(false);
    none(marked(look(() => 'floor')));
    none(marked(look((x, y) => (within(x, y, 1, 1.08) ? 'nothing' : 'floor'))));
    none(
      marked(look((x, y) => (within(x, y, 1, 1.15) ? 'thing' : within(x, y, 1, 2.4) ? 'nothing' : 'floor'))),
    );
    // A camera that sees no floor at all, or nothing at all.
    none(marked(look(() => 'nothing')));
    none(marked({ depth: new Float32Array(SIZE * SIZE), classes: new Uint8Array(160 * 160) }));
  });

  test('does not include columns at the image’s border of which the camera gives nothing', () => {
    const classes = marked(
      look(
        () => 'floor',
        (u) => u >= 30 && u < 130,
      ),
    );
    expect(classes.includes(dropOff)).toBe(false);
  });

  test('is looked for where the robot stands and how it is turned', () => {
    const { depth } = look((x, y) => (within(x, y, 1, 1.6) ? 'nothing' : 'floor'));
    const classes = new Uint8Array(160 * 160);
    const turned = { x: 0.03, y: 0.01, yaw: Math.PI / 2 };
    // The grid of a robot that looks along y.
    for (let x = -0.6; x < 0.6; x += 0.05) for (let y = 0.5; y < 2.6; y += 0.05) classes[cellOf(x, y)] = free;
    for (let x = -0.28; x < 0.35; x += 0.05)
      for (let y = 1.02; y < 1.62; y += 0.05) classes[cellOf(x, y)] = unknown;
    marked({ depth, classes }, turned);
    expect(classes[cellOf(0.03, 1.3)]).toBe(dropOff);
    expect(classes[cellOf(1.3, 0)]).toBe(unknown);
  });
});
