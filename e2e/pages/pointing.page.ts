/** Pointing at the floor in the headset and by finger, so that the other operators of the robot see it. */
import { type Headset, headsetViewport } from '../src/headset.ts';
import { chooseBySteps, consoleIn, countPulses, enterVr, pinchAt, shownIn } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

const pointersOf = (stage: Stage) =>
  stage.script(({ app }) => app.stage.pointers.shown.map(({ name, at }) => ({ name, at })));
const sentOf = async (stage: Stage) => (await stage.sent('point')).map(({ at }) => at);

test.describe('in the headset', () => {
  test.use({ viewport: headsetViewport });

  /** Others are there, and the robot passes on where this operator points. */
  async function enter(stage: Stage): Promise<Headset> {
    const headset = await enterVr(stage, { state: 'people' });
    await consoleIn(stage);
    await stage.tell({ type: 'pointing', may: true });
    await stage.run(300);
    // Free of the wrist's panel, at the floor some metres ahead.
    for (const hand of ['left', 'right'] as const) {
      await headset.place(hand, [hand === 'left' ? -0.3 : 0.3, 1.3, -0.4]);
      await headset.tilt(hand, 0.35);
    }
    await headset.frames(3);
    return headset;
  }

  /** The hand that does not drive aims for long enough. */
  async function aim(stage: Stage, headset: Headset): Promise<void> {
    await headset.button('left', 'squeeze', 1);
    await stage.run(400);
  }

  test('the grip of the hand that does not drive aims, and opened it points: all see the ring and the name', async ({
    stage,
  }) => {
    const headset = await enter(stage);
    await aim(stage, headset);
    const aimed = (await consoleIn(stage)).aim.find((spot) => spot !== null);
    // Ahead of the robot, on its floor; nobody else sees it yet.
    expect(aimed?.x).toBeGreaterThan(1);
    expect([await sentOf(stage), await pointersOf(stage)]).toEqual([[], []]);
    await headset.button('left', 'squeeze', 0);
    await stage.run(100);
    const [at] = await sentOf(stage);
    expect(at?.x).toBeCloseTo(aimed?.x ?? 0, 1);
    expect(await pointersOf(stage)).toEqual([{ name: 'You', at }]);
    expect((await consoleIn(stage)).aim).toEqual([null, null]);
    await stage.tell({ type: 'pointed', by: 2, at: { x: 3, y: 1, z: 0 } });
    await stage.run(100);
    expect(await pointersOf(stage)).toContainEqual({ name: 'Bo', at: { x: 3, y: 1, z: 0 } });
    expect((await stage.state()).driving).toBe(false);
  });

  test('names of those who point keep their size before the eyes in each view', async ({ stage }) => {
    const headset = await enter(stage);
    /** Height of a name over its distance, both in the operator's room. */
    const nameShare = async () => {
      await stage.tell({ type: 'pointed', by: 2, at: { x: 4, y: 1, z: 0 } });
      await stage.run(100);
      return stage.script(({ app: { stage } }) => {
        const [ring] = stage.pointers.object.children;
        const name = ring?.children[1];
        if (ring === undefined || name === undefined) throw new Error('nobody points');
        const at = ring.getWorldPosition(ring.position.clone());
        const eyes = stage.camera.getWorldPosition(ring.position.clone());
        return name.scale.y / (at.distanceTo(eyes) / stage.rig.scale.x);
      });
    };
    const shares = [await nameShare()];
    for (let view = 0; view < 2; view++) {
      await headset.press('left', 'x-button');
      shares.push(await nameShare());
    }
    expect(await stage.script(({ app }) => app.stage.rig.scale.x)).toBe(20);
    for (const share of shares) expect(share).toBeCloseTo(0.04, 3);
  });

  test('it also points while the other hand drives on, and at nothing above the horizon', async ({
    stage,
  }) => {
    const headset = await enter(stage);
    await stage.script(({ robot }) => robot.giveLease('you'));
    await headset.button('right', 'squeeze', 1);
    await headset.thumbstick('right', 0, -1);
    await aim(stage, headset);
    expect((await stage.state()).driving).toBe(true);
    await headset.button('left', 'squeeze', 0);
    await stage.run(100);
    expect(await sentOf(stage)).toHaveLength(1);
    expect((await stage.state()).driving).toBe(true);
    await headset.tilt('left', -0.5);
    await aim(stage, headset);
    await headset.button('left', 'squeeze', 0);
    await stage.run(300);
    expect(await sentOf(stage)).toHaveLength(1);
    expect((await shownIn(stage)).notice?.rows.join(' ')).toContain('Point the ray at the floor.');
  });

  test('the menu or a headset that is put down ends the aim; a trigger meanwhile releases nothing', async ({
    stage,
  }) => {
    const headset = await enter(stage);
    await headset.press('right', 'b-button');
    await stage.run(200);
    expect((await stage.state()).estop).toBe(true);
    await aim(stage, headset);
    await headset.button('left', 'trigger', 1);
    await stage.run(1500);
    expect((await stage.state()).estop).toBe(true);
    await headset.button('left', 'trigger', 0);
    await headset.press('right', 'a-button');
    await headset.button('left', 'squeeze', 0);
    await stage.run(200);
    await headset.press('right', 'a-button');
    await aim(stage, headset);
    await headset.worn(false);
    await stage.run(200);
    await headset.button('left', 'squeeze', 0);
    await headset.worn(true);
    await stage.run(300);
    await aim(stage, headset);
    // A headset need not draw a frame while it is put down.
    await stage.script(({ app }) => app.vr.onHidden?.());
    await headset.button('left', 'squeeze', 0);
    await stage.run(300);
    expect(await sentOf(stage)).toEqual([]);
  });

  test('the menu’s entry lets the next trigger point, and the hand feels it', async ({ stage }) => {
    const headset = await enter(stage);
    await headset.press('right', 'a-button');
    await chooseBySteps(stage, headset, 'Point at the floor');
    await stage.run(300);
    expect((await shownIn(stage)).notice?.rows.join(' ')).toContain('Aim at the floor');
    const pulses = await countPulses(stage);
    await headset.press('right', 'trigger');
    await stage.run(100);
    expect([(await sentOf(stage)).length, await pulses()]).toEqual([1, 1]);
    await headset.press('right', 'trigger');
    await stage.run(200);
    expect(await sentOf(stage)).toHaveLength(1);
  });

  test('a trigger that points takes no hold of the model on the table', async ({ stage }) => {
    const headset = await enter(stage);
    for (let view = 0; view < 2; view++) await headset.press('left', 'x-button');
    await headset.press('right', 'a-button');
    await chooseBySteps(stage, headset, 'Point at the floor');
    await headset.tilt('right', 0.9);
    await stage.run(200);
    const { model } = await shownIn(stage);
    await headset.button('right', 'trigger', 1);
    await headset.frames(2);
    await headset.place('right', [0.3, 1.35, -0.45]);
    await headset.frames(2);
    expect((await shownIn(stage)).model).toEqual(model);
    await headset.button('right', 'trigger', 0);
    await stage.run(100);
    expect(await sentOf(stage)).toHaveLength(1);
  });

  test('a bare hand points by the menu’s entry and a pinch', async ({ stage }) => {
    const headset = await enter(stage);
    await headset.bareHands(true);
    await headset.bareHand('left', [-0.2, 1.3, -0.45], 0);
    await headset.tilt('right', 0);
    await headset.bareHand('right', [0.2, 1.3, -0.3], 0);
    await stage.frames(5);
    await pinchAt(headset, (await consoleIn(stage)).tab.menu);
    const { menu } = await consoleIn(stage);
    await pinchAt(headset, menu?.places[menu.items.indexOf('Point at the floor')]);
    await headset.tilt('right', 0.5);
    for (const pinches of [0, 1, 0]) await headset.bareHand('right', [0.3, 1.3, -0.3], pinches);
    await stage.run(100);
    expect(await sentOf(stage)).toHaveLength(1);
  });

  test('where nobody sees it, the grip aims at nothing, and no label nor entry says that it does', async ({
    stage,
  }) => {
    const headset = await enter(stage);
    const labels = async () => (await consoleIn(stage)).labels.flatMap(({ texts }) => texts);
    await headset.place('left', [-0.3, 1.15, -0.4]);
    await stage.run(300);
    expect(await labels()).toContain('Squeeze: point at floor');
    await stage.tell({ type: 'pointing', may: false });
    await stage.run(500);
    expect(await labels()).not.toContain('Squeeze: point at floor');
    await aim(stage, headset);
    expect((await consoleIn(stage)).aim).toEqual([null, null]);
    await headset.button('left', 'squeeze', 0);
    await headset.press('right', 'a-button');
    expect((await consoleIn(stage)).menu?.items).not.toContain('Point at the floor');
    expect(await sentOf(stage)).toEqual([]);
  });
});

test.describe('by finger', () => {
  test.use({ hasTouch: true });

  /** Two places on the floor before the robot, pixels of the page. */
  async function open(stage: Stage) {
    const page = await stage.open({ state: 'people', canvas: '640x360' });
    await stage.tell({ type: 'pointing', may: true });
    const canvas = (await page.locator('#stage').boundingBox())!;
    const at = (right: number, down: number) => ({
      x: canvas.x + canvas.width * right,
      y: canvas.y + canvas.height * down,
    });
    return { page, near: at(0.5, 0.6), beside: at(0.55, 0.6), sky: at(0.5, 0.3) };
  }
  const yawOf = (stage: Stage) => stage.script(({ app }) => app.stage.look.yaw);

  test('one that is held still on the view points once, and neither turns, zooms, drives nor selects', async ({
    stage,
  }) => {
    const { page, near, beside } = await open(stage);
    await stage.fingers('touchStart', near);
    await stage.run(450);
    expect(await sentOf(stage)).toEqual([]);
    await stage.run(100);
    const [at] = await sentOf(stage);
    expect(at?.x).toBeGreaterThan(0.5);
    expect(Math.abs(at?.y ?? 9)).toBeLessThan(0.2);
    // Held on and moved, it does nothing more.
    await stage.fingers('touchMove', beside);
    await stage.run(1000);
    await stage.fingers('touchEnd');
    expect(await sentOf(stage)).toHaveLength(1);
    expect(await yawOf(stage)).toBe(0);
    expect((await stage.state()).driving).toBe(false);
    expect(await page.evaluate(() => String(getSelection()))).toBe('');
  });

  test('one that moves turns the view, two zoom, a short one does nothing: none points', async ({
    stage,
  }) => {
    const { near, beside } = await open(stage);
    await stage.fingers('touchStart', near);
    await stage.fingers('touchMove', beside);
    await stage.run(1000);
    await stage.fingers('touchEnd');
    expect(await yawOf(stage)).not.toBe(0);
    await stage.fingers('touchStart', near);
    await stage.fingers('touchStart', near, beside);
    await stage.run(1000);
    await stage.fingers('touchEnd');
    await stage.fingers('touchStart', near);
    await stage.run(400);
    await stage.fingers('touchEnd');
    await stage.run(1000);
    expect(await sentOf(stage)).toEqual([]);
  });

  test('above the horizon there is no floor, and the page says what to do', async ({ stage }) => {
    const { page, sky } = await open(stage);
    await stage.fingers('touchStart', sky);
    await stage.run(600);
    await stage.fingers('touchEnd');
    await expect(page.locator('#notice')).toHaveText('Point at the floor: hold a finger on it.');
    expect(await sentOf(stage)).toEqual([]);
  });
});

test('from above, the mouse points at the floor, too', async ({ stage }) => {
  const page = await stage.open({ state: 'people', canvas: '640x360' });
  await stage.tell({ type: 'pointing', may: true });
  await page.keyboard.press('KeyT');
  await stage.run(300);
  const canvas = (await page.locator('#stage').boundingBox())!;
  await page.mouse.move(canvas.x + canvas.width / 2, canvas.y + canvas.height * 0.4);
  await page.keyboard.press('KeyG');
  await stage.run(100);
  expect(await sentOf(stage)).toHaveLength(1);
});
