/** What a robot's topics say, in the table over the picture. */
import type { Page } from '@playwright/test';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

test.use({ viewport: { width: 1280, height: 720 } });

/** As much as a reading can say. */
const LONG = Array.from({ length: 10 }, (_, i): [string, string] => [
  `left motor of the axle number ${i}`,
  'which has 71 degrees, and that is too warm to go on for long',
]);
const fact = (page: Page, name: string) =>
  page.locator('#facts dt', { hasText: new RegExp(`^${name}$`) }).locator('+ dd');

/** A reading that the robot repeats, as robots do. */
async function read(
  stage: Stage,
  [topic, label]: readonly [topic: string, label: string],
  level: 'ok' | 'warn' | 'error',
  values: readonly (readonly [string, string])[],
): Promise<void> {
  await stage.script(
    (stage, [topic, label, level, values]) => {
      const tell = () =>
        stage.tell({
          ...{ type: 'reading', topic, label, level, ageMs: 0, timeMs: stage.robot.nowMs },
          values: values.map(([name, value]) => [name, value]),
        });
      tell();
      setInterval(tell, 500);
    },
    [topic, label, level, values] as const,
  );
}

test('a robot’s readings are shown: several figures, the battery’s instead of the robot’s own, and long texts that leave room for the picture', async ({
  stage,
}) => {
  const page = await stage.open();
  await expect(fact(page, 'Battery')).toHaveText('80 %');
  await read(stage, ['/battery', 'Battery'], 'ok', [
    ['', '75 %'],
    ['', '25.1 V'],
  ]);
  await read(stage, ['/temperature', 'Gripper'], 'ok', [['', '21.5']]);
  // Its name is taken by a figure of the robot's own.
  await read(stage, ['/odom', 'Speed'], 'ok', [['', '0.1']]);
  await read(stage, ['/diagnostics', 'Diagnostics'], 'warn', LONG);
  await stage.run(400);
  await expect(fact(page, 'Battery')).toHaveText('75 % · 25.1 V');
  await expect(fact(page, 'Gripper')).toHaveText('21.5');
  await expect(fact(page, 'Diagnostics')).toHaveText(
    LONG.map(([name, value]) => `${name}: ${value}`).join(' · '),
  );
  await expect(fact(page, 'Speed \\(/odom\\)')).toHaveText('0.1');
  const panel = await page.locator('#facts').boundingBox();
  expect(panel?.width).toBeLessThan(400);
  expect(await expectNothingCovered(page, 'long texts')).toContain('facts');
});
