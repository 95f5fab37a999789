import { Group, Object3D, Quaternion, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { DEFAULT_HEADSET, type HeadsetSettings } from '../../ground/headset-settings.ts';
import { HeadsetRig } from './headset-rig.ts';

const FRAME_MS = 11;
const UP = new Vector3(0, 1, 0);

/** A headset on a head, and a robot that it follows. Places of three.js, m. */
class Bench {
  readonly headset: HeadsetRig;
  readonly rig = new Group();
  /** In the tracked space. */
  readonly head = new Vector3(0.2, 1.5, -0.1);
  headYaw = 0;
  robot = { x: 3, y: -2, z: 0.4, yaw: 1 };
  ground = 0.1;

  constructor(settings: Partial<HeadsetSettings> = {}) {
    this.headset = new HeadsetRig({ ...DEFAULT_HEADSET, ...settings });
    this.recentre();
    this.frames(1);
  }

  recentre(): void {
    const turn = new Quaternion().setFromAxisAngle(UP, this.headYaw);
    const { x, y, z } = this.head;
    this.headset.recentre({ x, y, z } as DOMPointReadOnly, turn as unknown as DOMPointReadOnly);
  }

  frames(count: number, stick = 0): void {
    this.headset.turnStick = stick;
    const head = new Object3D();
    head.position.copy(this.head);
    head.rotation.y = this.headYaw;
    for (let i = 0; i < count; i++) this.headset.place(this.rig, head, this.robot, this.ground, FRAME_MS);
  }

  /** Where the eyes are in the robot's world, REP-103, m. */
  eyes(): [number, number, number] {
    this.rig.updateMatrixWorld(true);
    const { x, y, z } = this.rig.localToWorld(this.head.clone());
    return [-z, -x, y];
  }

  /** Where the face points in the robot's world, radians. */
  get facing(): number {
    return this.rig.rotation.y + this.headYaw;
  }
}

function expectNear(found: readonly number[], wanted: readonly number[]): void {
  for (const [i, value] of wanted.entries()) expect(found[i]).toBeCloseTo(value, 9);
}

describe('HeadsetRig', () => {
  test('recentred, the eyes are at the robot’s camera and face its heading, wherever the head is', () => {
    const bench = new Bench();
    expectNear(bench.eyes(), [3, -2, 0.4]);
    expect(bench.facing).toBeCloseTo(1, 9);
    bench.head.set(-1, 1.1, 2);
    bench.headYaw = -2;
    bench.robot.yaw = 0.3;
    bench.recentre();
    bench.frames(1);
    expectNear(bench.eyes(), [3, -2, 0.4]);
    expect(bench.facing).toBeCloseTo(0.3, 9);
    // What hangs before the operator is before the eyes.
    bench.rig.add(bench.headset.front);
    bench.rig.updateMatrixWorld(true);
    const ahead = bench.headset.front.localToWorld(new Vector3(0, 0, -1));
    expectNear([-ahead.z, -ahead.x, ahead.y], [3 + Math.cos(0.3), -2 + Math.sin(0.3), 0.4]);
  });

  test('the view follows the robot’s place and not its turning, and leaves the edge alone', () => {
    const bench = new Bench();
    const { facing } = bench;
    bench.robot = { x: 5, y: -2, z: 0.4, yaw: 2.5 };
    bench.frames(20);
    expectNear(bench.eyes(), [5, -2, 0.4]);
    expect(bench.facing).toBe(facing);
    expect(bench.headset.darkness).toBe(0);
  });

  test('says on which side the robot’s front is, once the operator no longer sees it', () => {
    const bench = new Bench();
    expect(bench.headset.frontSide).toBe(0);
    bench.robot.yaw += 1;
    bench.frames(1);
    expect(bench.headset.frontSide).toBe(-1);
    // By the head or by the stick.
    bench.headYaw += 0.6;
    bench.frames(1);
    expect(bench.headset.frontSide).toBe(0);
    bench.headYaw -= 0.6;
    bench.frames(1, -1);
    expect(bench.headset.frontSide).toBe(0);
    bench.robot.yaw -= 3;
    bench.frames(1);
    expect(bench.headset.frontSide).toBe(1);
    // In the other views the robot itself is to be seen.
    bench.headset.show('tabletop');
    bench.frames(1);
    expect(bench.headset.frontSide).toBe(0);
  });

  test('set to, it turns with the robot, and the edge is dark for as long', () => {
    const bench = new Bench({ turn: 'robot', vignette: 1 });
    for (let i = 0; i < 30; i++) {
      bench.robot.yaw += 0.01;
      bench.frames(1);
    }
    expect(bench.facing).toBeCloseTo(1.3, 9);
    expect(bench.headset.darkness).toBeGreaterThan(0.9);
    bench.frames(300);
    expect(bench.headset.darkness).toBe(0);
  });

  test('a jump to another robot darkens nothing', () => {
    const bench = new Bench({ turn: 'robot', vignette: 1 });
    bench.headset.align();
    bench.robot = { x: 50, y: 9, z: 0, yaw: -2 };
    bench.frames(1);
    expect(bench.headset.darkness).toBe(0);
  });

  test('a step of the stick turns about the head, also of one who has walked away', () => {
    const bench = new Bench();
    bench.head.add(new Vector3(0.7, 0.1, 0.4));
    bench.frames(1);
    const [before, { facing }] = [bench.eyes(), bench];
    bench.frames(5, 1);
    expect(bench.facing).toBeCloseTo(facing - Math.PI / 6, 9);
    expectNear(bench.eyes(), before);
    bench.frames(1);
    bench.frames(5, -1);
    expect(bench.facing).toBeCloseTo(facing, 9);
    expectNear(bench.eyes(), before);
    // Recentring undoes the steps.
    bench.frames(1);
    bench.frames(1, 1);
    bench.recentre();
    bench.frames(1);
    expect(bench.facing).toBeCloseTo(facing, 9);
    expectNear(bench.eyes(), [3, -2, 0.4]);
  });

  test('standing: the eyes are as high above the robot’s floor as above one’s own', () => {
    const bench = new Bench({ posture: 'standing' });
    // Without a floor, as a seated operator.
    expectNear(bench.eyes(), [3, -2, 0.4]);
    bench.headset.floorY = -0.05;
    bench.frames(1);
    expectNear(bench.eyes(), [3, -2, 0.1 + 1.55]);
    bench.head.y = 1.1;
    bench.frames(1);
    expectNear(bench.eyes(), [3, -2, 0.1 + 1.15]);
  });

  test('over the shoulder: the robot is ahead, and the stick turns about it', () => {
    const bench = new Bench();
    bench.headset.show('over-shoulder');
    bench.frames(1);
    expectNear(bench.eyes(), [3 - 2.4 * Math.cos(1), -2 - 2.4 * Math.sin(1), 1.0]);
    bench.frames(2, -1);
    const yaw = 1 + Math.PI / 6;
    expectNear(bench.eyes(), [3 - 2.4 * Math.cos(yaw), -2 - 2.4 * Math.sin(yaw), 1.0]);
  });

  test('tabletop: the robot stays at its place on the table while it drives, turns and is scaled', () => {
    const bench = new Bench();
    bench.headset.show('tabletop');
    const onTable = () => {
      bench.rig.updateMatrixWorld(true);
      const { x, y } = bench.robot;
      const at = bench.rig.worldToLocal(new Vector3(-y, bench.ground, -x));
      return [at.x - 0.2, at.y - 1.5, at.z + 0.1];
    };
    const { model } = bench.headset;
    for (let i = 0; i < 5; i++) {
      bench.robot.x += 0.3;
      bench.robot.yaw += 0.2;
      bench.frames(1, i % 2);
      expectNear(onTable(), [model.x, model.y, model.z]);
    }
    const hand = (x: number, z: number) => ({ holds: true, x, y: -0.4, z });
    model.follow(hand(-0.2, -0.6), hand(0.2, -0.6));
    bench.frames(1);
    const { yaw } = bench.headset;
    model.follow(hand(0, -0.2), hand(0, -1));
    bench.frames(1);
    // Turned to the left by a quarter, the model's ahead is to the operator's left.
    expect(bench.headset.yaw).toBeCloseTo(yaw - Math.PI / 2, 9);
    expect(model.scale).toBeCloseTo(0.1, 9);
    expectNear(onTable(), [model.x, model.y, model.z]);
    expect(bench.headset.darkness).toBe(0);
    bench.headset.show('first-person');
    bench.frames(1);
    expect(bench.rig.scale.x).toBe(1);
  });
});
