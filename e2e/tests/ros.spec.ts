import { writeFileSync } from 'node:fs';
import { Ros1Peers } from '@farpoint/ros/testing/ros1';
import { OperatorPage } from '../src/operator-page.ts';
import { expect, test } from '../src/stack-test.ts';

const { python, missing } = Ros1Peers.find();
const robot = { id: 'ros-1', name: 'Robot in a ROS graph' };

test('a robot in a ROS 1 graph: its cloud, its readings, and driving it', async ({
  page,
  startStack,
}, testInfo) => {
  test.skip(python === null, missing ?? '');
  const peers = await Ros1Peers.open(python ?? '');
  try {
    await peers.startCore();
    await peers.startNode('cloud,state,diagnostics', 'camera');
    const base = await peers.startNode('velocity', 'base');
    const config = testInfo.outputPath('farpoint.yaml');
    writeFileSync(
      config,
      `
robot:
  source: { kind: ros1 }
  sink: { kind: ros1 }
  ros: { master: '${peers.masterUrl}', hostname: 127.0.0.1 }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /camera_info, as: cameraInfo }
    - { topic: /odom, as: pose }
    - { topic: /battery, as: battery }
    - { topic: /diagnostics, as: diagnostics }
    - { topic: /temperature, type: std_msgs/Float32, as: text, label: Gripper }
    - { topic: /cmd_vel, as: velocity }
`,
    );
    const stack = await startStack({ robots: [{ ...robot, args: ['--config', config] }] });
    const operator = await OperatorPage.open(page, stack, { robot: robot.id });
    await operator.expectPoints(5000);
    const fact = (name: string) => page.locator('#facts dt', { hasText: name }).locator('+ dd');
    await expect(fact('Battery')).toHaveText('75 % · 25.1 V');
    await expect(fact('Gripper')).toHaveText('21.5');
    await expect(fact('Diagnostics')).toContainText('left motor: 71 degrees, which is too warm');
    // Long words do not hide the picture.
    const panel = await page.locator('#facts').boundingBox();
    expect(panel?.width).toBeLessThan(400);
    await operator.screenshot(testInfo, 'ros');

    await operator.holdForward();
    await expect.poll(() => base.heard.at(-1)?.x ?? 0).toBeGreaterThan(0.2);
    await operator.releaseKeys();
    await expect.poll(() => base.heard.at(-1)?.x).toBe(0);
  } finally {
    await peers.close();
  }
});
