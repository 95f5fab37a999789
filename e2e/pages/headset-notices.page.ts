/** The sign before the eyes in the headset: what it says, when it comes and goes, and that the hands feel it. */
import { type Headset, headsetViewport } from '../src/headset.ts';
import { countPulses, enterVr, shownIn, wristOf } from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

test.use({ viewport: headsetViewport });

/** Limit after the robot's last word, ms. */
const TOLD_MS = 1000;
/** By then a sign has wholly come or gone, ms. */
const FADED_MS = 250;
/** How long a passing notice stays, ms. */
const PASSED_MS = 5500;

/** A notice passes. Nobody looks meanwhile: two eyes of each frame would take the test's time. */
async function pass(stage: Stage): Promise<void> {
  await stage.freeze();
  await stage.run(PASSED_MS - 2 * FADED_MS);
  await stage.thaw();
  await stage.run(2 * FADED_MS);
}

/** The sign's words; `null` while it shows nothing. It is below the way ahead and can be read, whatever it says. */
async function signOf(stage: Stage): Promise<string | null> {
  const { notice } = await shownIn(stage);
  if (notice === null) return null;
  expect(notice.letterDegrees).toBeGreaterThanOrEqual(1);
  expect(notice.topDegrees).toBeLessThanOrEqual(-15);
  expect(notice.bottomDegrees).toBeGreaterThan(-45);
  expect(notice.widthDegrees).toBeLessThan(40);
  return notice.rows.join(' ');
}

async function drive(stage: Stage, headset: Headset): Promise<void> {
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', 0, -1);
  await stage.run(400);
  expect((await stage.state()).driving).toBe(true);
}

test('a killed robot: within a second the sign says what has happened and what to do, until it is back', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  await pass(stage);
  expect(await signOf(stage)).toBeNull();
  await drive(stage, headset);
  const pulses = await countPulses(stage);
  await stage.script((control) => {
    control.cut();
    control.link.list([]);
  });
  await stage.run(TOLD_MS);
  expect(await signOf(stage)).toMatch(/^The robot is gone .* stops by itself\. .*Let go of the grip\./);
  expect(await pulses()).toBeGreaterThan(0);
  await headset.button('right', 'squeeze', 0);
  await headset.thumbstick('right', 0, 0);
  await pass(stage);
  expect(await signOf(stage)).not.toContain('Let go');
  const felt = await pulses();
  await stage.script((control) => {
    control.restore();
    control.link.list([{ id: control.robot.id, name: control.robot.name }]);
  });
  await pass(stage);
  await stage.run(1500);
  expect(await signOf(stage)).toBeNull();
  expect(await pulses()).toBe(felt);
});

test('STOP by another: the sign says who pressed it and how it is released, and the hands feel it once', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  const pulses = await countPulses(stage);
  await stage.script(({ robot }) =>
    robot.stop({ latched: true, by: 'operator', latch: 1 }, { pressedBy: 'Bo' }),
  );
  await pass(stage);
  expect(await signOf(stage)).toBe(
    'Emergency stop Bo pressed STOP. To release it, open both hands, then hold a trigger for one second.',
  );
  expect(await pulses()).toBe(1);
  await headset.button('right', 'trigger', 1);
  await stage.run(1300);
  await headset.button('right', 'trigger', 0);
  await stage.run(FADED_MS);
  expect((await stage.state()).estop).toBe(false);
  expect(await signOf(stage)).toBeNull();
});

test('a stop at the robot is released there, and the sign says so', async ({ stage }) => {
  await enterVr(stage, { state: 'stopped-at-robot' });
  await pass(stage);
  expect(await signOf(stage)).toMatch(/^Emergency stop .*at the robot, and nowhere else\.$/);
});

test('a stick without its grip: the sign says what to squeeze, fades out and in, and the hands feel it once', async ({
  stage,
}) => {
  const headset = await enterVr(stage);
  await pass(stage);
  const pulses = await countPulses(stage);
  await headset.thumbstick('right', 0, -1);
  await stage.run(600);
  const { notice } = await shownIn(stage);
  expect(await signOf(stage)).toBe('Squeeze the grip, too: the robot moves only while you do.');
  await stage.run(FADED_MS);
  expect((await shownIn(stage)).notice?.opacity).toBeGreaterThan(0.9);
  expect(notice?.opacity).toBeGreaterThan(0);
  await pass(stage);
  expect(await signOf(stage)).toBeNull();
  expect(await pulses()).toBe(1);
});

test('without cues the hands feel nothing, and the sign says the same', async ({ stage }) => {
  const headset = await enterVr(stage, { stored: { 'farpoint.settings': { cues: false } } });
  const pulses = await countPulses(stage);
  await headset.thumbstick('right', 0, -1);
  await stage.run(700);
  expect(await signOf(stage)).toContain('Squeeze the grip');
  await headset.press('right', 'b-button');
  await stage.run(300);
  expect(await signOf(stage)).toMatch(/^Emergency stop You pressed STOP\./);
  expect(await pulses()).toBe(0);
});

test('a robot that is held while the grip is: the sign says why, and says nothing once the hand opens', async ({
  stage,
}) => {
  const headset = await enterVr(stage, { state: 'obstacle-ahead' });
  await pass(stage);
  expect(await signOf(stage)).toBeNull();
  await headset.button('right', 'squeeze', 1);
  await headset.thumbstick('right', 0, -1);
  await stage.run(600);
  expect(await signOf(stage)).toBe('Held: something is in the way');
  await headset.button('right', 'squeeze', 0);
  await headset.thumbstick('right', 0, 0);
  await stage.run(600);
  expect(await signOf(stage)).toBeNull();
});

test('the next view is told of with what the hands do in it, and without a pulse', async ({ stage }) => {
  const headset = await enterVr(stage);
  await pass(stage);
  const pulses = await countPulses(stage);
  await headset.press('left', 'x-button');
  expect(await signOf(stage)).toBe(
    'View in the headset: over the shoulder Other stick: turn · squeeze right: drive',
  );
  expect(await pulses()).toBe(0);
  // It is as large and as far below the line of sight where the world is a model.
  await headset.press('left', 'x-button');
  expect(await signOf(stage)).toContain('tabletop');
  await pass(stage);
  expect(await signOf(stage)).toBeNull();
});

test('without a robot the sign and the wrist say which press connects, and the press does it', async ({
  stage,
}) => {
  const headset = await enterVr(stage, { state: 'disconnected' });
  await stage.run(400);
  expect(await signOf(stage)).toBe(
    'No robot is chosen Press the right stick to connect to Robot on a stage. The menu lists all robots.',
  );
  const wrist = async () => (await wristOf(stage)).map(({ text }) => text);
  expect(await wrist()).toContain('press right stick: Robot on a stage');
  await headset.press('right', 'thumbstick');
  await pass(stage);
  expect(await stage.state()).toMatchObject({ robotId: 'stage-1', session: 'live' });
  expect(await signOf(stage)).toBeNull();
});

for (const [state, says] of [
  ['no-robots', /No robots are online\. They appear here/],
  ['service-away', /cannot be reached, so no robots can be listed\. Check the network/],
  ['token-refused', /refused this page’s token/],
] as const)
  test(`no robot is listed (${state}): the sign and the wrist say why, and what to do`, async ({ stage }) => {
    await enterVr(stage, { state });
    await stage.run(400);
    expect(await signOf(stage)).toMatch(says);
    const wrist = (await wristOf(stage)).map(({ text }) => text).join('\n');
    expect(wrist).toMatch(/No robots are online|no robots can be listed|lists no robots/);
    // Robots that appear are offered at once.
    await stage.script(({ robot, link }) => robot.appear(link));
    await stage.run(400);
    expect(await signOf(stage)).toContain('Press the right stick');
  });

test('a robot that does not admit the operator: the hands feel it once, and the sign says where it is answered', async ({
  stage,
}) => {
  const headset = await enterVr(stage, { state: 'disconnected' });
  const pulses = await countPulses(stage);
  await stage.script((stage) => {
    stage.robot.onRequest = () => stage.link.end('not-granted', 'no grant for this robot');
  });
  await headset.press('right', 'thumbstick');
  await pass(stage);
  expect(await signOf(stage)).toMatch(/^The robot does not admit you .*leave VR/);
  expect(await pulses()).toBe(1);
});
