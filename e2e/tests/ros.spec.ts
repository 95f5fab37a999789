import { expect, test } from '../src/stack-test.ts';

test('a robot in a ROS 1 graph: its cloud, its readings, and driving it', async ({
  page,
  openRos1Robot,
}, testInfo) => {
  const { nodes, operator } = await openRos1Robot({
    nodes: [
      ['camera', 'cloud,state,diagnostics'],
      ['base', 'velocity'],
    ],
    topics: [
      { topic: '/odom', as: 'pose' },
      { topic: '/battery', as: 'battery' },
      { topic: '/diagnostics', as: 'diagnostics' },
      { topic: '/temperature', type: 'std_msgs/Float32', as: 'text', label: 'Gripper' },
      { topic: '/cmd_vel', as: 'velocity' },
    ],
    sink: 'ros1',
  });
  const fact = (name: string) => page.locator('#facts dt', { hasText: name }).locator('+ dd');
  await expect(fact('Battery')).toHaveText('75 % · 25.1 V');
  await expect(fact('Gripper')).toHaveText('21.5');
  await expect(fact('Diagnostics')).toContainText('left motor: 71 degrees, which is too warm');
  // Long texts do not hide the picture.
  const panel = await page.locator('#facts').boundingBox();
  expect(panel?.width).toBeLessThan(400);
  await operator.look(testInfo, 'ros');

  await operator.holdForward();
  await expect
    .poll(async () => {
      await operator.gripAnew();
      return nodes[1]?.heard.at(-1)?.x ?? 0;
    })
    .toBeGreaterThan(0.2);
  await operator.releaseKeys();
  await expect.poll(() => nodes[1]?.heard.at(-1)?.x).toBe(0);
});
