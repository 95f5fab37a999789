/** A click on the floor sends the robot there; it goes as long as its driver is there, and no longer. */
import type { Page, TestInfo } from '@playwright/test';
import { enterVr, Headset, headsetViewport } from '../src/headset.ts';
import { OperatorPage, screenSizes } from '../src/operator-page.ts';
import { expect, lightRobot, test } from '../src/stack-test.ts';

/** A page on a busy machine has pauses, at which the robot rightly ends a goal: here it is more patient. */
const PATIENT = [
  ...[
    '--watchdog-ms',
    '1000',
    '--view-slow-ms',
    '1000',
    '--view-brake-ms',
    '2500',
    '--view-stall-ms',
    '1500',
  ],
];
const robot = {
  ...lightRobot,
  args: [...lightRobot.args, '--sim-size', '160', '--goals', 'sim', ...PATIENT],
};
/** There is furniture farther ahead, m. */
const NEAR_M = 0.7;

const goal = async (operator: OperatorPage) => (await operator.state()).goal;
const notice = (page: Page) => page.locator('#notice');

/** A place that is so far ahead of the robot, m, and to its left. */
async function ahead(operator: OperatorPage, metres: number, left = 0): Promise<{ x: number; y: number }> {
  const { x, y, yaw } = await operator.body();
  return {
    x: x + metres * Math.cos(yaw) - left * Math.sin(yaw),
    y: y + metres * Math.sin(yaw) + left * Math.cos(yaw),
  };
}

/** Where that is on the page, pixels. */
async function onPage(page: Page, place: { x: number; y: number }): Promise<{ x: number; y: number }> {
  const shown = await page.evaluate((at) => window.farpoint.floorOnScreen(at), place);
  const box = await page.locator('#stage').boundingBox();
  if (shown === null || box === null) throw new Error('the place is not on the screen');
  return { x: box.x + shown.x * box.width, y: box.y + shown.y * box.height };
}

async function clickOn(page: Page, operator: OperatorPage, place: { x: number; y: number }): Promise<void> {
  await expect.poll(async () => (await goal(operator)).armed).toBe(true);
  const { x, y } = await onPage(page, place);
  await page.mouse.click(x, y);
}

async function pictures(page: Page, operator: OperatorPage, testInfo: TestInfo, name: string): Promise<void> {
  for (const size of screenSizes) {
    await page.setViewportSize(size);
    await operator.expectFrames(3);
    await operator.look(testInfo, `${name}-${size.width}`);
  }
  await page.setViewportSize({ width: 1280, height: 720 });
  await operator.expectFrames(3);
}

async function expectStaying(operator: OperatorPage): Promise<void> {
  await operator.expectStanding();
  const stands = await operator.body();
  await operator.expectFrames(10);
  const later = await operator.body();
  expect(Math.hypot(later.x - stands.x, later.y - stands.y)).toBeLessThan(0.01);
}

test('a click from above sends the robot there, and it arrives', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('t');
  await operator.expectFrames(3);
  await page.keyboard.press('g');
  await expect(page.locator('#go-to')).toHaveAttribute('aria-pressed', 'true');
  await expect(page.locator('#goal-state')).toHaveText('Click on the floor');
  const place = await ahead(operator, NEAR_M);
  await clickOn(page, operator, place);
  await expect(page.locator('#goal-state')).toHaveText(/^Going, 0\.\d m$/);
  const { marked, armed } = await goal(operator);
  expect(armed).toBe(false);
  expect(Math.hypot((marked?.x ?? 0) - place.x, (marked?.y ?? 0) - place.y)).toBeLessThan(0.05);
  await expect(page.locator('#goal-state')).toHaveText('Arrived');
  await expect(page.getByRole('status').filter({ hasText: 'Arrived' })).toBeVisible();
  await pictures(page, operator, testInfo, 'arrived');
  const { x, y } = await operator.body();
  expect(Math.hypot(x - place.x, y - place.y)).toBeLessThan(0.25);
  await expectStaying(operator);
  await expect(page.locator('#goal-state')).toBeHidden();
  expect((await goal(operator)).marked).toBeNull();
});

test('from the robot’s own eyes, a click sends it to what it sees there', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('g');
  // The floor at the robot's feet is below what is in view: the nearest that is not.
  const places = await Promise.all([1.2, 1.6, 2, 2.5].map((metres) => ahead(operator, metres)));
  const inView = await page.evaluate(
    (all) => all.findIndex((at) => (window.farpoint.floorOnScreen(at)?.y ?? 1) < 0.75),
    places,
  );
  const place = places[inView];
  if (place === undefined) throw new Error('no place ahead is in view');
  await clickOn(page, operator, place);
  await expect(page.locator('#goal-state')).toHaveText(/^(Going|Stopped)/);
  const { marked } = await goal(operator);
  expect(Math.hypot((marked?.x ?? 0) - place.x, (marked?.y ?? 0) - place.y)).toBeLessThan(0.1);
  await operator.look(testInfo, 'own-eyes');
  await page.keyboard.press('Escape');
  await expectStaying(operator);
});

test('from behind the robot, a drag says where it is to look', async ({ page, startStack }, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  // Behind the robot, where the floor at its feet is in view.
  await page.keyboard.press('v');
  await operator.expectFrames(3);
  await page.locator('#go-to').click();
  const from = await onPage(page, await ahead(operator, NEAR_M));
  const to = await onPage(page, await ahead(operator, NEAR_M, 0.8));
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 4 });
  await operator.expectFrames(3);
  await operator.look(testInfo, 'heading');
  const { yaw } = await operator.body();
  const { marked } = await goal(operator);
  expect((marked?.yaw ?? 0) - yaw).toBeCloseTo(Math.PI / 2, 1);
  await page.mouse.up();
  await expect(page.locator('#goal-state')).toHaveText(/^Going/);
  await operator.look(testInfo, 'going');
  await expect(page.locator('#goal-state')).toHaveText('Arrived');
  expect((await operator.body()).yaw - yaw).toBeCloseTo(Math.PI / 2, 0);
});

test('Escape, the driver’s own hand and STOP end it, and nothing goes on by itself', async ({
  page,
  startStack,
}, testInfo) => {
  const stack = await startStack({ robots: [robot] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('t');
  await operator.expectFrames(3);
  const going = async (metres: number) => {
    await page.keyboard.press('g');
    await clickOn(page, operator, await ahead(operator, metres));
    await expect(page.locator('#goal-state')).toHaveText(/^Going/);
    // What the page has heard of the robot is older than what it has said itself.
    await expect
      .poll(async () => {
        const { velocity } = await operator.state();
        return Math.abs(velocity?.linear ?? 0) + Math.abs(velocity?.angular ?? 0);
      })
      .toBeGreaterThan(0.1);
  };
  await going(NEAR_M);
  await page.keyboard.press('Escape');
  await expect(page.locator('#goal-state')).toHaveText('Cancelled: you took it back');
  await expectStaying(operator);
  await going(-NEAR_M);
  await page.keyboard.down('Space');
  await expect(page.locator('#goal-state')).toHaveText('Cancelled: you took the stick');
  await pictures(page, operator, testInfo, 'cancelled');
  await page.keyboard.up('Space');
  await expectStaying(operator);
  await going(-NEAR_M);
  await page.keyboard.press('x');
  await operator.expectState('estop', true);
  await expect(page.locator('#goal-state')).toHaveText('Cancelled: the emergency stop is on');
  await operator.releaseEstop();
  await expectStaying(operator);
});

test('something in the way stops it', async ({ page, startStack }, testInfo) => {
  const blocked = { ...robot, args: [...robot.args, '--sim-things', '1.3,0,1'] };
  const stack = await startStack({ robots: [blocked] });
  const operator = await OperatorPage.open(page, stack, { robot: robot.id });
  await operator.expectPoints(300);
  await page.keyboard.press('t');
  await operator.expectFrames(3);
  await page.keyboard.press('g');
  await clickOn(page, operator, await ahead(operator, 2.5));
  await expect(page.locator('#goal-state')).toHaveText('Stopped: something is in the way');
  await pictures(page, operator, testInfo, 'blocked');
  await expectStaying(operator);
});

test('a robot that takes no goals offers none', async ({ page, startStack }) => {
  const stack = await startStack({ robots: [lightRobot] });
  const operator = await OperatorPage.open(page, stack, { robot: lightRobot.id });
  await operator.expectPoints(300);
  await expect(page.locator('#go-to')).toBeHidden();
  await page.keyboard.press('g');
  await expect(notice(page)).toHaveText('This robot takes no goals.');
  expect(await goal(operator)).toEqual({ armed: false, state: null, reason: null, marked: null, said: '' });
});

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  test('the headset sends the robot to where a held trigger points, takes it back, and tells of refusals', async ({
    page,
    startStack,
  }, testInfo) => {
    const near = { ...robot, args: [...robot.args, '--goals-max-m', '2'] };
    const stack = await startStack({ robots: [near] });
    const headset = await Headset.wear(page);
    const operator = await OperatorPage.open(page, stack, { robot: near.id });
    await operator.expectPoints(300);
    await enterVr(page, operator);
    await headset.place('right', [0.15, 1.4, -0.3]);
    const said = async () => (await goal(operator)).said;
    const trigger = (pulled: boolean) => headset.button('right', 'trigger', pulled ? 1 : 0);

    await headset.aim('right', 1);
    await trigger(true);
    await expect.poll(said).toBe('Let go: the robot comes here');
    await operator.look(testInfo, 'aimed');
    const { marked } = await goal(operator);
    const { x, y } = await operator.body();
    expect(Math.hypot((marked?.x ?? 99) - x, (marked?.y ?? 99) - y)).toBeLessThan(2);
    expect((await goal(operator)).state).toBeNull();
    await trigger(false);
    await expect.poll(said).toMatch(/^Going/);
    await operator.look(testInfo, 'going');
    // A click takes it back.
    await trigger(true);
    await headset.frames(1);
    await trigger(false);
    await expect.poll(said).toBe('Cancelled: you took it back');
    await expectStaying(operator);

    // A grip that drives ends the aiming, and nothing comes of that trigger any more.
    await trigger(true);
    await expect.poll(said).toMatch(/^(Keep holding|Let go)/);
    await headset.button('right', 'squeeze', 1);
    await expect.poll(said).not.toMatch(/^(Keep holding|Let go)/);
    await headset.button('right', 'squeeze', 0);
    await trigger(false);
    await headset.frames(3);
    expect((await goal(operator)).state).toBe('cancelled');

    await headset.aim('right', 0.2);
    await trigger(true);
    await expect.poll(said).toBe('Let go: the robot comes here');
    await trigger(false);
    await expect.poll(said).toBe('Not going: it is too far away');
    await operator.look(testInfo, 'refused');
    await headset.aim('right', -0.3);
    await trigger(true);
    await expect(page.locator('#goal-state')).toHaveText('There is no floor there');
    await trigger(false);
    await expectStaying(operator);
  });
});
