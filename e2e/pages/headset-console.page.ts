/** The console in the headset: the menu, the labels on the controllers, STOP and the menu for hands that point. */
import { STAGE_STATES, type StageStateName } from '@farpoint/webxr/stage-states';
import { type Headset, headsetViewport } from '../src/headset.ts';
import { chooseBySteps, consoleIn, enterVr, openInVr, pinchAt, shownIn } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

test.use({ viewport: headsetViewport });

type Shown = Awaited<ReturnType<typeof consoleIn>>;
type Place = Shown['tab']['stop'];

/** Where only places and words count, few pixels are drawn. */
const SMALL = { width: 128, height: 72 };
/** By then a sheet has wholly come or gone, ms. */
const FADED_MS = 300;

/** The title of the menu; `null` while it is closed. */
async function menuOf(stage: Stage): Promise<string | null> {
  return (await consoleIn(stage)).menu?.title ?? null;
}

test('the menu opens by A beside the way ahead, by stick and trigger goes through its pages, and closes by either hand', async ({
  stage,
}) => {
  const headset = await enterVr(stage, { state: 'videos' });
  await consoleIn(stage);
  await headset.press('right', 'a-button');
  expect(await menuOf(stage)).toBe('Menu');
  await chooseBySteps(stage, headset, /^View/);
  await chooseBySteps(stage, headset, 'tabletop');
  expect((await shownIn(stage)).view).toBe('tabletop');
  expect(await menuOf(stage)).toBeNull();
  await headset.press('right', 'a-button');
  await chooseBySteps(stage, headset, 'Cameras ›');
  await chooseBySteps(stage, headset, /^Front/);
  await chooseBySteps(stage, headset, 'Enlarge');
  expect((await consoleIn(stage)).menu?.items).toContain('Back to the wrist');
  await headset.press('left', 'x-button');
  expect(await menuOf(stage)).toBeNull();
  // The view has not changed with it, and nothing was turned.
  expect((await shownIn(stage)).view).toBe('tabletop');
  await headset.press('right', 'a-button');
  await chooseBySteps(stage, headset, 'Leave VR');
  await stage.frames(5);
  expect((await stage.state()).vr).toBe(false);
});

test('the menu stays where it opened, closes when the hand drives, and does not open before its eyes', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  await consoleIn(stage);
  await headset.press('right', 'a-button');
  const before = (await consoleIn(stage)).menu?.box;
  await headset.head([0, 1.6, 0], 0.5);
  await headset.frames(3);
  // But for the way of the eyes when a head turns.
  expect(Math.abs(((await consoleIn(stage)).menu?.box.left ?? 0) - (before?.left ?? 0))).toBeLessThan(2);
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', 0, -1);
  await stage.run(400);
  expect(await menuOf(stage)).toBeNull();
  expect((await stage.state()).driving).toBe(true);
  await headset.press('right', 'a-button');
  expect(await menuOf(stage)).toBeNull();
  expect((await stage.state()).driving).toBe(true);
});

test('a request is told of on the sign and answered in the menu, and the drive is taken over there', async ({
  stage,
}) => {
  const headset = await enterVr(stage, { state: 'asked-to-drive' });
  await stage.run(600);
  expect((await shownIn(stage)).notice?.rows.join(' ')).toContain('“Bo” asks to drive. Answer in the menu.');
  await headset.press('right', 'a-button');
  await chooseBySteps(stage, headset, 'Give the drive');
  await stage.run(400);
  expect((await stage.state()).holder).toBe('other');
  await headset.press('right', 'a-button');
  await chooseBySteps(stage, headset, 'Take over');
  await stage.run(400);
  expect((await stage.state()).holder).toBe('you');
});

test('a bare hand points at the wrist: the menu opens, an entry is pinched, and STOP latches; it releases nothing', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  await consoleIn(stage);
  await headset.bareHands(true);
  await headset.bareHand('left', [-0.2, 1.3, -0.45], 0);
  await headset.bareHand('right', [0.2, 1.3, -0.3], 0);
  await stage.frames(5);
  const pinch = async (place: (shown: Shown) => Place | undefined) =>
    pinchAt(headset, place(await consoleIn(stage)));
  await pinch(({ tab }) => tab.menu);
  expect(await menuOf(stage)).toBe('Menu');
  await pinch(({ menu }) => menu?.places[menu.items.indexOf('Readings ›')]);
  expect(await menuOf(stage)).toBe('Readings');
  await pinch(({ tab }) => tab.stop);
  expect((await stage.state()).estop).toBe(true);
  // Pinched for longer than a trigger is held to release it.
  await headset.bareHand('right', [0.2, 1.3, -0.3], 1);
  await stage.run(1500);
  expect((await stage.state()).estop).toBe(true);
});

/** Hands as they hang when nobody looks at them, and held up before the eyes. */
const HANGING = { left: [-0.22, 1.15, -0.3], right: [0.22, 1.15, -0.3] } as const;
const HELD_UP = { left: [-0.1, 1.42, -0.42], right: [0.1, 1.42, -0.42] } as const;
const AHEAD = { left: -15, right: 15, bottom: -15, top: 15 };

type Box = typeof AHEAD;
const isCovered = (a: Box, b: Box) =>
  a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;

/** Nothing covers anything, nor the way ahead, and all letters can be read. */
async function expectClear(stage: Stage, on: string): Promise<void> {
  const [{ menu, labels, sign, wrist }, { notice }] = [await consoleIn(stage), await shownIn(stage)];
  const boxes: [string, Box][] = [['the way ahead', AHEAD]];
  if (menu !== null) boxes.push(['menu', menu.box]);
  if (sign !== null) boxes.push(['sign', sign]);
  // A hand that is held up puts its panel where the operator wants it.
  if (wrist !== null && !on.includes('held up')) boxes.push(['wrist', wrist]);
  for (const { hand, box } of labels) boxes.push([`labels ${hand}`, box]);
  for (const [i, [what, box]] of boxes.entries())
    for (const [other, otherBox] of boxes.slice(i + 1))
      expect(
        isCovered(box, otherBox),
        `${on}: ${what} ${JSON.stringify(box)} and ${other} ${JSON.stringify(otherBox)}`,
      ).toBe(false);
  if (menu !== null) expect(menu.letterDegrees, on).toBeGreaterThanOrEqual(0.8);
  for (const { letterDegrees } of labels) expect(letterDegrees, on).toBeGreaterThanOrEqual(1);
  if (notice !== null) expect(notice.letterDegrees, on).toBeGreaterThanOrEqual(1);
}

/** Sheets come or go. Nobody looks meanwhile: two eyes of each frame would take the test's time. */
async function settle(stage: Stage): Promise<void> {
  await stage.freeze();
  await stage.run(FADED_MS);
  await stage.thaw();
  await stage.frames(2);
}

async function hold(headset: Headset, places: typeof HANGING | typeof HELD_UP): Promise<void> {
  for (const hand of ['left', 'right'] as const) await headset.place(hand, [...places[hand]]);
}

test('labels say what each control does now: in the first minute, then beside a hand before the eyes', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  await consoleIn(stage);
  await hold(headset, HANGING);
  await settle(stage);
  const labels = async () => {
    const { labels } = await consoleIn(stage);
    return Object.fromEntries(labels.map(({ hand, texts }) => [hand, texts.join(' · ')]));
  };
  expect(await labels()).toEqual({
    right: 'Stick: steer, with grip · B: STOP · A: menu · Squeeze: drive',
    left: 'Stick: turn the view · Press stick: recentre · Y: STOP · X: next view',
  });
  await stage.freeze();
  await stage.run(60_000);
  await stage.thaw();
  await stage.frames(2);
  await settle(stage);
  expect(await labels()).toEqual({});
  await headset.place('right', [0.06, 1.5, -0.45]);
  await settle(stage);
  await headset.button('right', 'squeeze', 1);
  await stage.run(400);
  expect(await labels()).toEqual({ right: 'Stick: steer · B: STOP · Let go: robot stops' });
  // Before the way ahead, a hand has none.
  await headset.place('right', [-0.12, 1.6, -0.42]);
  await stage.frames(2);
  await settle(stage);
  expect(await labels()).toEqual({});
});

test('a menu whose code cannot be loaded says so, and B stops all the same', async ({ stage }) => {
  await stage.page.route(/vr-console/, (route) => route.abort());
  const refused = stage.page.waitForEvent('requestfailed');
  const headset = await enterVr(stage);
  await refused;
  await stage.run(400);
  expect((await shownIn(stage)).notice?.rows.join(' ')).toContain('The menu could not be loaded.');
  await headset.press('right', 'a-button');
  await headset.press('right', 'b-button');
  expect((await stage.state()).estop).toBe(true);
});

/** All states of the page, each of them in one of a few tests. */
const STATES = Object.keys(STAGE_STATES) as StageStateName[];
const TESTS = 4;
/** Of a session, as few as it takes to be there. */
const FIRST_FRAMES = 6;
/** When a state has come about that takes longer than others, ms. */
const LATE: Partial<Record<StageStateName, number>> = {
  'stop-unconfirmed': 2500,
  'path-lost': 2500,
  'robot-lost': 2500,
  'link-lost': 2500,
  'taken-over': 1500,
};

for (let part = 0; part < TESTS; part++)
  test(`in each state (${part + 1}): STOP by B, the menu opens and closes, and nothing covers anything`, async ({
    stage,
  }) => {
    await stage.page.setViewportSize(SMALL);
    const states = STATES.filter((_, i) => i % TESTS === part);
    const headset = await enterVr(stage, { state: states[0] ?? 'live' });
    for (const [i, state] of states.entries()) {
      if (i > 0) await openInVr(stage, { state, forMs: LATE[state] ?? 600 }, FIRST_FRAMES);
      await consoleIn(stage);
      await hold(headset, HANGING);
      await settle(stage);
      await expectClear(stage, `${state}, hands hanging`);
      await headset.press('right', 'a-button');
      await hold(headset, HELD_UP);
      await settle(stage);
      await expectClear(stage, `${state}, menu open, hands held up`);
      expect(await menuOf(stage)).toBe('Menu');
      await stage.forget();
      await headset.press('right', 'b-button');
      const { session, estop } = await stage.state();
      // Where the path is cut, nobody can confirm it.
      if (session === 'live') expect(estop || (await stage.sent('estop')).length > 0, state).toBe(true);
      await headset.press('right', 'a-button');
      expect(await menuOf(stage)).toBeNull();
    }
  });
