/** The robot's model, of shapes and of meshes: seen from outside with its joints where they are, never from the robot's own eyes. */
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { binaryStl, torus } from '@farpoint/meshes/testing';
import type { TestInfo } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, LONG, lightRobot, test } from '../src/stack-test.ts';

const robot = { ...lightRobot, args: [...lightRobot.args, '--sim-size', '160'] };
/** Base, its lid, its front, caster, mast and camera; tyre and mark of two wheels. */
const SHAPES = 10;

const model = async (operator: OperatorPage) => (await operator.state()).model;

async function expectDrawn(operator: OperatorPage, drawn: boolean): Promise<void> {
  await expect.poll(() => model(operator)).toMatchObject({ links: 2, shapes: SHAPES, drawn });
}

test('it is seen from behind and from above, its wheels turn, and it can be hidden', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await expectDrawn(operator, false);
  await operator.look(testInfo, 'own-eyes');
  for (const [key, view] of [
    ['v', 'behind'],
    ['t', 'above'],
  ] as const) {
    await page.keyboard.press(key);
    await expectDrawn(operator, true);
    for (const size of screenSizes) {
      await page.setViewportSize(size);
      await operator.expectFrames(3);
      await operator.look(testInfo, `${view}-${size.width}`);
    }
  }
  await page.setViewportSize(screenSizes[1]);
  await page.keyboard.press('t');
  const before = (await model(operator)).positions;
  await page.evaluate(() => window.farpoint.drive({ forward: 1, left: 0 }, 600));
  await expect
    .poll(async () => (await model(operator)).positions, { message: 'angles of the wheels' })
    .not.toEqual(before);
  await operator.look(testInfo, 'driven');
  await page.locator('#colours-open').click();
  const shown = page.locator('#robot-model');
  await expect(shown).toHaveText('Drawn');
  await shown.click();
  await expect.poll(() => model(operator)).toMatchObject({ shapes: 0, drawn: false });
  await operator.expectFrames(3);
  await operator.look(testInfo, 'hidden');
  await shown.click();
  await expectDrawn(operator, true);
});

test('a robot without a model has its outline', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [{ ...robot, args: [...robot.args, '--urdf', 'none'] }] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('v');
  await operator.expectFrames(3);
  expect(await model(operator)).toMatchObject({ links: 0, shapes: 0, drawn: false });
  await operator.look(testInfo, 'without');
});

/** A robot of two meshes on boxes: its body, and a ring that turns; a third mesh is of a format that is not read. */
function meshRobot(testInfo: TestInfo) {
  const folder = testInfo.outputPath('share');
  const meshes = join(folder, 'ring_robot', 'meshes');
  mkdirSync(meshes, { recursive: true });
  writeFileSync(join(meshes, 'body.stl'), binaryStl(torus(96, 48, 220, 90)));
  writeFileSync(join(meshes, 'ring.stl'), binaryStl(torus(64, 24, 0.2, 0.03)));
  writeFileSync(join(meshes, 'mast.dae'), '<COLLADA/>');
  const link = (name: string, mesh: string, colour: string, box: string) => `<link name="${name}">
    <visual><geometry><mesh filename="package://ring_robot/meshes/${mesh}/></geometry>
      <material name="${name}"><color rgba="${colour} 1"/></material></visual>
    <collision><geometry><box size="${box}"/></geometry></collision></link>`;
  const joint = (
    name: string,
    type: string,
    child: string,
    z: number,
  ) => `<joint name="${name}" type="${type}">
    <parent link="base_link"/><child link="${child}"/><origin xyz="0 0 ${z}"/><axis xyz="0 1 0"/></joint>`;
  const urdf = join(folder, 'robot.urdf');
  writeFileSync(
    urdf,
    `<robot name="rings">
    ${link('base_link', 'body.stl" scale="0.001 0.001 0.001"', '0.2 0.75 0.7', '0.6 0.6 0.18')}
    ${link('left_wheel', 'ring.stl"', '0.95 0.68 0.24', '0.46 0.06 0.46')}
    ${link('mast', 'mast.dae"', '0.5 0.56 0.62', '0.08 0.08 0.4')}
    ${joint('left_wheel_joint', 'continuous', 'left_wheel', 0.5)}${joint('mast_joint', 'fixed', 'mast', 0.9)}
    </robot>`,
  );
  const withMeshes = ['--urdf', urdf, '--mesh-dir', folder];
  return {
    read: { ...robot, args: [...robot.args, ...withMeshes] },
    unread: { ...robot, args: [...robot.args, ...withMeshes.slice(0, 2)] },
  };
}

test('meshes take the place of the shapes that stood for them, and the page says which are not drawn', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [meshRobot(testInfo).read] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('v');
  await expect.poll(() => model(operator)).toMatchObject({ links: 1, shapes: 1, meshes: 2, drawn: true });
  await expect(page.locator('#facts')).toContainText('collision shapes for 1 mesh');
  await expect(page.locator('#facts')).toContainText('mast.dae: COLLADA is not read');
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(3);
    await operator.look(testInfo, `meshes-${size.width}`);
  }
  const before = (await model(operator)).positions;
  await page.evaluate(() => window.farpoint.drive({ forward: 1, left: 0 }, 600));
  await expect.poll(async () => (await model(operator)).positions).not.toEqual(before);
});

test('without a folder for meshes the shapes stay, and the page says why', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [meshRobot(testInfo).unread] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('v');
  await expect.poll(() => model(operator)).toMatchObject({ links: 1, shapes: 3, meshes: 0, drawn: true });
  await expect(page.locator('#facts')).toContainText('the robot has no folder for meshes');
  await operator.expectFrames(3);
  await operator.look(testInfo, 'boxes');
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('it is seen over the shoulder, not from the robot’s own eyes', async ({
    page,
    startStack,
  }, testInfo) => {
    const stack = await startStack({ robots: [robot] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id });
    await operator.expectPoints(300);
    await enterVr(page, operator);
    await expectDrawn(operator, false);
    await headset.press('left', 'x-button');
    await expectDrawn(operator, true);
    await operator.expectFrames(5);
    await operator.look(testInfo, 'headset');
  });

  test('its meshes are seen over the shoulder', { tag: LONG }, async ({ page, startStack }, testInfo) => {
    const stack = await startStack({ robots: [meshRobot(testInfo).read] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: robot.id });
    await operator.expectPoints(300);
    await enterVr(page, operator);
    await headset.press('left', 'x-button');
    await expect.poll(() => model(operator)).toMatchObject({ meshes: 2, drawn: true });
    await operator.expectFrames(5);
    await operator.look(testInfo, 'headset-meshes');
  });
});
