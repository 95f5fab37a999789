import { createHash } from 'node:crypto';
import { longProperty } from '@farpoint/network-sim/cases';
import { type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, onTestFinished, test } from 'vitest';
import {
  type CloudFrame,
  depthToMillimetres,
  Simulation,
  type SimulationOptions,
  type WorldDescription,
} from './index.ts';
import { officeWorld } from './worlds/office.ts';

function twist(linear: number, angular: number): Twist {
  const command = zeroTwist();
  command.linear.x = linear;
  command.angular.z = angular;
  return command;
}

async function simulate(options: Partial<SimulationOptions> = {}): Promise<Simulation> {
  const simulation = await Simulation.create({ seed: 1, ...options });
  onTestFinished(() => simulation.close());
  return simulation;
}

/** A long wall straight ahead, and nothing else. */
function wallWorld(distance: number): WorldDescription {
  return {
    name: 'wall',
    start: { x: 0, y: 0, yaw: 0 },
    lampSpacing: 3,
    materials: { paint: { texture: 'checker', colour: 0xffffff, second: 0x404040, size: 0.3 } },
    boxes: [{ centre: { x: distance + 0.5, y: 0, z: 0 }, size: { x: 1, y: 200, z: 200 }, material: 'paint' }],
    panels: [],
    ellipsoids: [],
    movers: [],
  };
}

function digest(frame: CloudFrame): string {
  const { buffer, byteOffset, byteLength } = frame.points;
  return createHash('sha256')
    .update(new Uint8Array(buffer, byteOffset, byteLength))
    .digest('hex')
    .slice(0, 32);
}

function invalidShare(frame: CloudFrame): number {
  let invalid = 0;
  for (let i = 2; i < frame.points.length; i += 4) if (!(frame.points[i]! > 0)) invalid++;
  return invalid / (frame.width * frame.height);
}

/** A drive through the hall that ends in a frame. */
async function drive(seed: number): Promise<string[]> {
  const simulation = await simulate({ seed });
  const digests: string[] = [];
  for (const [linear, angular] of [
    [0.8, 0],
    [0.5, -0.6],
    [0.7, 0.4],
  ] as const) {
    simulation.setCommand(twist(linear, angular));
    for (let i = 0; i < 20; i++) simulation.step(1 / 30);
    digests.push(digest(simulation.renderFrame()));
  }
  return digests;
}

describe('determinism', () => {
  test('the frames of a drive are these, bit for bit, on any machine', async () => {
    expect(await drive(7)).toEqual(GOLDEN);
  });

  test('another run gives the same frames, another seed different ones', async () => {
    const [first, again, other] = [await drive(8), await drive(8), await drive(9)];
    expect(again).toEqual(first);
    expect(other[0]).not.toBe(first[0]);
  });

  test('the result does not depend on how time is divided into calls', async () => {
    const [whole, pieces] = [await simulate(), await simulate()];
    for (const simulation of [whole, pieces]) simulation.setCommand(twist(0.6, 0.3));
    whole.step(2);
    for (let i = 0; i < 2000; i++) pieces.step(0.001);
    expect(pieces.state).toEqual(whole.state);
    expect(whole.state.time).toBe(2);
  });
});

describe('camera', () => {
  test('a wall straight ahead is at its distance, and unprojects by the intrinsics', async () => {
    const simulation = await simulate({ world: wallWorld(3), camera: { pitch: 0, forward: 0.1 } });
    const frame = simulation.renderFrame({ groundTruth: true });
    const { fx, fy, cx, cy, width, height } = frame.intrinsics;
    expect([width, height, fx]).toEqual([480, 480, 240]);
    for (let row = 0; row < height; row += 7) {
      for (let column = 0; column < width; column += 7) {
        const pixel = row * width + column;
        const [x, y, z] = frame.points.subarray(4 * pixel, 4 * pixel + 3);
        expect(z).toBeCloseTo(2.9, 5);
        expect(frame.depth[pixel]).toBe(z);
        expect(x).toBeCloseTo(((column - cx) / fx) * 2.9, 4);
        expect(y).toBeCloseTo(((row - cy) / fy) * 2.9, 4);
      }
    }
    const measured = simulation.renderFrame();
    let worst = 0;
    for (const z of measured.depth) if (z > 0) worst = Math.max(worst, Math.abs(z - 2.9));
    expect(worst).toBeGreaterThan(0.01);
    expect(worst).toBeLessThan(6 * 0.0016 * 2.9 ** 2);
  });

  test('depth noise grows with the square of depth', async () => {
    for (const distance of [1, 2, 4, 8]) {
      const simulation = await simulate({ world: wallWorld(distance), camera: { pitch: 0, forward: 0 } });
      const valid = simulation.renderFrame().depth.filter((z) => z > 0);
      const mean = valid.reduce((sum, z) => sum + z, 0) / valid.length;
      const sigma = Math.sqrt(valid.reduce((sum, z) => sum + (z - mean) ** 2, 0) / valid.length);
      const perSquare = sigma / distance ** 2;
      expect(perSquare).toBeGreaterThan(0.00145);
      expect(perSquare).toBeLessThan(0.00175);
    }
  });

  test('camera pose and points together give a wall its true position', async () => {
    const simulation = await simulate({ world: wallWorld(3) });
    simulation.setCommand(twist(0.3, 0.5));
    simulation.step(1);
    const frame = simulation.renderFrame({ groundTruth: true });
    const { position, orientation: q } = frame.cameraPose;
    let checked = 0;
    for (let i = 0; i < frame.points.length; i += 4 * 997) {
      const [x, y, z] = [frame.points[i]!, frame.points[i + 1]!, frame.points[i + 2]!];
      if (!(z > 0)) continue;
      // World x of the point, by the first row of the rotation matrix.
      const worldX =
        position.x +
        (1 - 2 * (q.y ** 2 + q.z ** 2)) * x +
        2 * (q.x * q.y - q.z * q.w) * y +
        2 * (q.x * q.z + q.y * q.w) * z;
      expect(worldX).toBeCloseTo(3, 2);
      checked++;
    }
    expect(checked).toBeGreaterThan(100);
  });

  test('about a tenth of the pixels is invalid, and invalid is NaN everywhere', async () => {
    const simulation = await simulate();
    for (let i = 0; i < 5; i++) {
      simulation.step(1);
      const frame = simulation.renderFrame();
      const share = invalidShare(frame);
      expect(share).toBeGreaterThan(0.07);
      expect(share).toBeLessThan(0.15);
      for (let pixel = 0; pixel < frame.depth.length; pixel += 13) {
        const [x, y, z] = frame.points.subarray(4 * pixel, 4 * pixel + 3);
        const valid = frame.depth[pixel]! > 0;
        const right = valid ? z === frame.depth[pixel] : !Number.isFinite(x! + y! + z!);
        if (!right) expect.fail(`pixel ${pixel}: depth ${frame.depth[pixel]}, point ${x}, ${y}, ${z}`);
      }
    }
  });

  test('images without points are the same images', async () => {
    const [whole, images] = [await simulate({}), await simulate({})].map((simulation, i) =>
      simulation.renderFrame({ points: i === 0 }),
    );
    expect(images!.points.length).toBe(0);
    expect(images!.depth).toEqual(whole!.depth);
    expect(images!.colour).toEqual(whole!.colour);
  });

  test('points carry the colours of the picture', async () => {
    const simulation = await simulate();
    const { points, colour } = simulation.renderFrame();
    const words = new Uint32Array(points.buffer, points.byteOffset, points.length);
    const picture = new Uint32Array(colour.buffer, colour.byteOffset, colour.length / 4);
    const seen = new Set<number>();
    for (let pixel = 0; pixel < picture.length; pixel++) {
      if (words[4 * pixel + 3] !== picture[pixel]) expect.fail(`pixel ${pixel} differs`);
      if (picture[pixel]! >>> 24 !== 255) expect.fail(`pixel ${pixel} is not opaque`);
      seen.add(picture[pixel]!);
    }
    expect(seen.size).toBeGreaterThan(1000);
  });

  test('other sizes and fields of view', async () => {
    const camera = { width: 320, height: 200, fieldOfView: 1.2 };
    const { intrinsics, points } = (await simulate({ camera })).renderFrame();
    expect(points.length).toBe(320 * 200 * 4);
    expect(2 * Math.atan(160 / intrinsics.fx)).toBeCloseTo(1.2, 9);
    expect([intrinsics.cx, intrinsics.cy]).toEqual([159.5, 99.5]);
  });

  test('two cameras do not affect each other', async () => {
    const first = await simulate({ seed: 3 });
    const before = digest(first.renderFrame());
    const second = await simulate({ seed: 3, camera: { width: 1280, height: 960 } });
    second.renderFrame();
    const again = await simulate({ seed: 3 });
    expect(digest(again.renderFrame())).toBe(before);
    expect(invalidShare(first.renderFrame())).toBeLessThan(0.15);
  });

  test('depth as millimetres', () => {
    const depth = new Float32Array([0, 1.2344, 1.2346, 70]);
    expect([...depthToMillimetres(depth)]).toEqual([0, 1234, 1235, 65535]);
  });

  test('refuses invalid options', async () => {
    await expect(simulate({ camera: { width: 482 } })).rejects.toMatchObject({ code: 'bad-camera' });
    await expect(simulate({ camera: { fieldOfView: 4 } })).rejects.toMatchObject({ code: 'out-of-range' });
    await expect(simulate({ camera: { noise: Number.NaN } })).rejects.toMatchObject({ code: 'not-finite' });
    await expect(simulate({ seed: -1 })).rejects.toMatchObject({ code: 'out-of-range' });
    const world = wallWorld(3);
    world.boxes[0]!.material = 'marble';
    await expect(simulate({ world })).rejects.toMatchObject({ code: 'bad-world', what: 'boxes[0]' });
    await expect(simulate({ world: wallWorld(0.1) })).rejects.toMatchObject({
      code: 'bad-world',
      what: 'start',
    });
  });
});

describe('motion', () => {
  test('drives straight and turns on the spot', async () => {
    const simulation = await simulate({ world: wallWorld(30) });
    simulation.setCommand(twist(0.5, 0));
    simulation.step(4.25);
    // A quarter of a metre less for accelerating: v²/2a is driven in v/a.
    expect(simulation.state.pose.position.x).toBeCloseTo(0.5 * 4.25 - 0.125, 2);
    expect(simulation.state.odometryDistance).toBeCloseTo(simulation.state.pose.position.x, 9);
    expect(simulation.state.wheelAngles.left).toBeCloseTo(simulation.state.odometryDistance / 0.08, 6);
    simulation.setCommand(twist(0, 0));
    simulation.step(1);
    const { x } = simulation.state.pose.position;
    simulation.setCommand(twist(0, 1));
    simulation.step(2);
    expect(simulation.state.pose.position.x).toBe(x);
    expect(simulation.state.yaw).toBeCloseTo(2 - 1 / 6, 2);
    expect(simulation.state.wheelSpeeds.left).toBeLessThan(0);
  });

  test('stops at a wall and reports it', async () => {
    const simulation = await simulate({ world: wallWorld(1) });
    simulation.setCommand(twist(1, 0));
    simulation.step(3);
    expect(simulation.state.collision).toBe(true);
    expect(simulation.state.pose.position.x).toBeCloseTo(0.75, 4);
    expect(simulation.state.twist.linear.x).toBeLessThan(0.01);
    simulation.setCommand(twist(-0.3, 0));
    simulation.step(1);
    expect(simulation.state.collision).toBe(false);
    expect(simulation.state.pose.position.x).toBeLessThan(0.6);
  });

  test('fits through the narrow door, but not off its middle', async () => {
    const simulation = await simulate();
    simulation.teleport(16.42, 6.3, -Math.PI / 2);
    simulation.setCommand(twist(0.5, 0));
    for (let i = 0; i < 120; i++) {
      simulation.step(1 / 30);
      expect(simulation.state.collision).toBe(false);
    }
    expect(simulation.state.pose.position.y).toBeLessThan(4.6);
    const other = await simulate();
    other.teleport(16.0, 6.3, -Math.PI / 2);
    other.setCommand(twist(0.5, 0));
    other.step(2.6);
    expect(other.state.collision).toBe(true);
    expect(other.state.pose.position.y).toBeGreaterThan(5);
  });

  test('no drive ends inside anything', async () => {
    const simulation = await simulate();
    const starts = [
      officeWorld().start,
      { x: 6, y: 7.9, yaw: -1 },
      { x: 3.5, y: 4, yaw: 1 },
      { x: 16, y: 3.9, yaw: 2 },
    ];
    const command = fc.tuple(
      fc.double({ min: -1, max: 1, noNaN: true }),
      fc.double({ min: -1.5, max: 1.5, noNaN: true }),
      fc.integer({ min: 1, max: 40 }),
    );
    fc.assert(
      fc.property(fc.constantFrom(...starts), fc.array(command, { maxLength: 12 }), (start, commands) => {
        simulation.teleport(start.x, start.y, start.yaw);
        for (const [linear, angular, count] of commands) {
          simulation.setCommand(twist(linear, angular));
          for (let i = 0; i < count; i++) {
            simulation.step(0.05);
            if (simulation.clearance < 0) expect.fail(`${-simulation.clearance} m inside something`);
          }
        }
      }),
      longProperty(1, 40),
    );
  });

  test('people walk, and wait for a robot in their way', async () => {
    const simulation = await simulate();
    const visitor = () => simulation.movers.find((mover) => mover.name === 'visitor')!;
    const before = visitor();
    simulation.step(1);
    const after = visitor();
    expect(Math.sqrt((after.x - before.x) ** 2 + (after.y - before.y) ** 2)).toBeCloseTo(0.9, 1);
    simulation.teleport(after.x + 1.5, after.y, 0);
    simulation.step(5);
    expect(visitor().walking).toBe(false);
    expect(simulation.state.collision).toBe(false);
    expect(simulation.clearance).toBeGreaterThan(0.25);
  });

  test('the battery drains while driving and charges at the dock', async () => {
    const simulation = await simulate();
    const start = simulation.state.battery.percentage;
    simulation.step(60);
    const driven = simulation.state.battery;
    expect(driven.percentage).toBeLessThan(start);
    expect(driven.charging).toBe(false);
    const dock = simulation.world.dock!;
    simulation.teleport(dock.x + 0.1, dock.y, 0);
    simulation.step(60);
    expect(simulation.state.battery.charging).toBe(true);
    expect(simulation.state.battery.percentage).toBeGreaterThan(driven.percentage);
  });

  test('refuses invalid commands and durations', async () => {
    const simulation = await simulate();
    expect(() => simulation.setCommand(twist(Number.NaN, 0))).toThrow(
      expect.objectContaining({ code: 'not-finite' }),
    );
    expect(() => simulation.step(Number.POSITIVE_INFINITY)).toThrow(
      expect.objectContaining({ code: 'not-finite' }),
    );
    expect(() => simulation.step(-1)).toThrow(expect.objectContaining({ code: 'out-of-range' }));
    expect(() => simulation.teleport(0, 0, 0)).toThrow(expect.objectContaining({ code: 'out-of-range' }));
    expect(simulation.state.time).toBe(0);
  });
});

/** After 20, 40 and 60 steps of the drive with seed 7. */
const GOLDEN = [
  '14c388dd6c3bfa340f6b88ef10387fb8',
  'ede7a446ecca228b514bad2db48c93ff',
  '331256fc65ff505c889f2463ef902673',
];
