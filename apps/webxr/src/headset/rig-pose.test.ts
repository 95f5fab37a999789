import { worldToThree } from '@farpoint/cloud-view';
import fc from 'fast-check';
import { Group, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { ABOVE_M, BEHIND_M, RigPose } from './rig-pose.ts';

const number = fc.double({ min: -20, max: 20, noNaN: true });
const place = fc.record({ x: number, y: number, z: number });

/** As the rim applies it. */
function rigOf(pose: RigPose): Group {
  const rig = new Group();
  rig.position.set(pose.x, pose.y, pose.z);
  rig.rotation.y = pose.yaw;
  rig.scale.setScalar(pose.scale);
  rig.updateMatrixWorld(true);
  return rig;
}
const three = ({ x, y, z }: { x: number; y: number; z: number }) =>
  new Vector3(x, y, z).applyMatrix4(worldToThree());

describe('RigPose', () => {
  test('first person: the origin is at the camera, at the eyes’ height, and ahead is along the heading', () => {
    fc.assert(
      fc.property(place, number, (camera, yaw) => {
        const pose = new RigPose();
        pose.firstPerson(camera, 1.2, yaw);
        const rig = rigOf(pose);
        expect(rig.localToWorld(new Vector3()).distanceTo(three({ ...camera, z: 1.2 }))).toBeLessThan(1e-9);
        const ahead = three({ x: camera.x + Math.cos(yaw), y: camera.y + Math.sin(yaw), z: 1.2 });
        expect(rig.localToWorld(new Vector3(0, 0, -1)).distanceTo(ahead)).toBeLessThan(1e-9);
        expect(pose.scale).toBe(1);
      }),
      { seed: 6 },
    );
  });

  test('over the shoulder: the robot’s camera is straight ahead and below', () => {
    fc.assert(
      fc.property(place, number, (camera, yaw) => {
        const pose = new RigPose();
        pose.overShoulder(camera, camera.z + ABOVE_M, yaw);
        const seen = rigOf(pose).worldToLocal(three(camera));
        expect(seen.distanceTo(new Vector3(0, -ABOVE_M, -BEHIND_M))).toBeLessThan(1e-9);
      }),
      { seed: 7 },
    );
  });

  test('tabletop: the robot stands at the model’s place, and a metre is as long as the scale says', () => {
    fc.assert(
      fc.property(
        place,
        place,
        fc.double({ min: 0.01, max: 1, noNaN: true }),
        number,
        (robot, at, scale, yaw) => {
          const pose = new RigPose();
          pose.tabletop(robot.x, robot.y, robot.z, { ...at, scale }, yaw);
          const rig = rigOf(pose);
          const shown = rig.worldToLocal(three(robot));
          expect(shown.distanceTo(new Vector3(at.x, at.y, at.z))).toBeLessThan(1e-6);
          const ahead = { x: robot.x + Math.cos(yaw), y: robot.y + Math.sin(yaw), z: robot.z };
          const step = rig.worldToLocal(three(ahead)).sub(shown);
          expect(step.distanceTo(new Vector3(0, 0, -scale))).toBeLessThan(1e-6);
        },
      ),
      { seed: 8 },
    );
  });
});
