/** The robot's commands in the headset's menu: by stick, by ray and by a bare hand. */
import { headsetViewport } from '../src/headset.ts';
import {
  chooseByRay,
  chooseBySteps,
  consoleIn,
  countPulses,
  enterVr,
  pinchAt,
  shownIn,
} from '../src/stage/in-headset.ts';
import { expect, test } from '../src/stage/page-test.ts';
import type { Stage } from '../src/stage/stage.ts';

test.use({ viewport: headsetViewport });

/** By then entries that have moved can be chosen, and a second press counts as one, ms. */
const SETTLED_MS = 600;

const menuOf = async (stage: Stage) => (await consoleIn(stage)).menu;
/** Each entry with what stands below it. */
async function entriesOf(stage: Stage): Promise<string[]> {
  const { items = [], notes = [] } = (await menuOf(stage)) ?? {};
  return items.map((text, entry) => [text, notes[entry]].filter(Boolean).join(' | '));
}
const calls = (stage: Stage) =>
  stage.script((control) => control.sent('callCommand').map(({ id, text }) => [id, text ?? null]));
const signOf = async (stage: Stage) => (await shownIn(stage)).notice?.rows.join(' ') ?? null;

test('by the stick: a command that must be confirmed, one that is refused, one that runs and is cancelled', async ({
  stage,
}) => {
  const headset = await enterVr(stage, { state: 'commands' });
  await consoleIn(stage);
  await headset.press('right', 'a-button');
  await chooseBySteps(stage, headset, 'Commands ›');
  expect(await entriesOf(stage)).toEqual([
    'Recording 1:02, 48 MB',
    'Stop recording',
    'Bookmark',
    'Signals',
    'Lights',
    'Horn | not while the emergency stop is on',
    'Power',
    'Dock',
    'More ›',
    '‹ Back',
  ]);
  const pulses = await countPulses(stage);
  await chooseBySteps(stage, headset, /^Horn/);
  await stage.run(SETTLED_MS);
  expect(await signOf(stage)).toContain('Horn: not while the emergency stop is on.');
  expect(await pulses()).toBe(1);
  await chooseBySteps(stage, headset, 'Dock');
  await stage.run(SETTLED_MS);
  expect(await calls(stage)).toEqual([]);
  await chooseBySteps(stage, headset, 'Press again: Dock');
  await stage.run(SETTLED_MS);
  expect(await calls(stage)).toEqual([['dock', null]]);
  await stage.script(({ robot }) => robot.tell({ type: 'commandRefused', request: 1, reason: 'too-often' }));
  await stage.run(SETTLED_MS);
  expect(await signOf(stage)).toContain('Dock: refused (given too often).');
  expect(await pulses()).toBe(2);
  await chooseBySteps(stage, headset, 'More ›');
  expect((await entriesOf(stage)).slice(0, 2)).toEqual([
    'Service',
    'Cancel: Self-test | 50 %, tests the camera (running, given by Bo)',
  ]);
  await chooseBySteps(stage, headset, 'Cancel: Self-test');
  await stage.run(100);
  expect(await stage.script((control) => control.sent('cancelCommand').map(({ run }) => run))).toEqual([1]);
  expect((await menuOf(stage))?.title).toBe('Commands');
});

test('a confirmation that comes too late is a first press again', async ({ stage }) => {
  const headset = await enterVr(stage, { state: 'commands' });
  await consoleIn(stage);
  await headset.press('right', 'a-button');
  await chooseBySteps(stage, headset, 'Commands ›');
  await chooseBySteps(stage, headset, 'Dock');
  await stage.run(3500);
  await chooseBySteps(stage, headset, 'Dock');
  await stage.run(SETTLED_MS);
  expect(await calls(stage)).toEqual([]);
  expect((await menuOf(stage))?.items).toContain('Press again: Dock');
});

test('by a ray: a bookmark without a note, and the end of the recording', async ({ stage }) => {
  const headset = await enterVr(stage, { state: 'commands' });
  await consoleIn(stage);
  await headset.press('right', 'a-button');
  await chooseByRay(stage, headset, 'Commands ›');
  await chooseByRay(stage, headset, 'Bookmark');
  await stage.run(SETTLED_MS);
  await chooseByRay(stage, headset, 'Stop recording');
  await stage.run(100);
  expect(await calls(stage)).toEqual([
    ['bookmark', null],
    ['record-stop', null],
  ]);
  await stage.script(({ robot }) =>
    robot.tell({ type: 'recording', on: false, bytes: 50_000_000, forS: 70 }),
  );
  await stage.run(SETTLED_MS);
  expect((await menuOf(stage))?.items.slice(0, 2)).toEqual(['Not recording', 'Record']);
});

test('by a bare hand: an entry is pinched', async ({ stage }) => {
  const headset = await enterVr(stage, { state: 'commands' });
  await consoleIn(stage);
  await headset.bareHands(true);
  await headset.bareHand('left', [-0.2, 1.3, -0.45], 0);
  await headset.bareHand('right', [0.2, 1.3, -0.3], 0);
  await stage.frames(5);
  await pinchAt(headset, (await consoleIn(stage)).tab.menu);
  for (const entry of ['Commands ›', 'Lights']) {
    const menu = await menuOf(stage);
    await pinchAt(headset, menu?.places[menu.items.indexOf(entry)]);
  }
  await stage.run(100);
  expect(await calls(stage)).toEqual([['lights', null]]);
});

test('a robot without commands has no such page', async ({ stage }) => {
  const headset = await enterVr(stage);
  await consoleIn(stage);
  await headset.press('right', 'a-button');
  expect((await menuOf(stage))?.items).not.toContain('Commands ›');
});
