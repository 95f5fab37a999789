/** Nothing covers anything: each state of the page on a phone, on a laptop and on a large screen. */
import type { StageStateName } from '@farpoint/webxr/stage-states';
import { expectNothingCovered } from '../src/stage/boxes.ts';
import { expect, test } from '../src/stage/page-test.ts';

/** Each state, and what must be seen in it on every screen. */
const STATES: Readonly<Record<StageStateName, readonly string[]>> = {
  blank: ['robots', 'settings-open'],
  'no-robots': ['robots', 'settings-open'],
  disconnected: ['robots', 'settings-open'],
  'session-over': ['robots', 'settings-open'],
  fleet: ['robots', 'settings-open'],
  'service-away': ['robots', 'settings-open'],
  'token-refused': ['robots', 'settings-open'],
  connecting: ['disconnect', 'settings-open'],
  'robot-full': ['disconnect', 'settings-open', 'banner'],
  'not-granted': ['obstacle', 'settings-open'],
  'key-changed': ['obstacle', 'settings-open'],
  live: ['estop', 'holder', 'facts'],
  still: ['estop', 'holder'],
  driving: ['estop', 'holder', 'release'],
  'other-drives': ['estop', 'holder', 'take'],
  'stop-latched': ['estop', 'estop-release', 'stop-band'],
  'stopped-at-robot': ['estop', 'estop-release', 'stop-band'],
  'stop-unconfirmed': ['estop', 'stop-state', 'banner'],
  'stop-by-other': ['estop', 'stop-band'],
  'path-lost': ['estop', 'banner'],
  'robot-lost': ['estop', 'banner'],
  'link-lost': ['estop', 'banner'],
  'decoder-hung': ['estop', 'facts'],
  'taken-over': ['estop', 'banner'],
  'unknown-robot': ['estop', 'banner'],
  'robot-gone': ['disconnect', 'estop', 'banner'],
  'view-too-old': ['estop', 'motion-state'],
  'view-late': ['estop', 'motion-state'],
  'obstacle-ahead': ['estop', 'motion-state', 'near'],
  'guard-blind': ['estop', 'obstacle-guard'],
  'guard-off': ['estop', 'obstacle-guard'],
  returning: ['estop', 'motion-state'],
  'came-back': ['estop', 'motion-state'],
  watching: ['estop', 'holder'],
  people: ['estop', 'people'],
  'asked-to-drive': ['estop', 'handover', 'handover-accept', 'handover-refuse'],
  'offered-the-drive': ['estop', 'handover', 'handover-accept', 'handover-refuse'],
  'own-request': ['estop', 'handover', 'handover-withdraw'],
  alarm: ['estop', 'alarm'],
  playback: ['estop', 'alarm', 'about'],
  recorded: ['estop', 'about'],
  commands: ['estop', 'commands'],
  'two-sensors': ['estop'],
  videos: ['estop', 'pictures'],
  cameras: ['estop', 'pictures'],
  everything: ['estop', 'estop-release', 'alarm', 'pictures'],
};
/** What opens further parts of a state, and what must be seen then. */
const OPENED: readonly {
  state: StageStateName;
  what: string;
  open: readonly string[];
  seen: readonly string[];
}[] = [
  {
    ...{ state: 'alarm', what: 'the dashboard', open: ['#dashboard-open'] },
    seen: ['dashboard', 'estop'],
  },
  {
    ...{ state: 'stop-latched', what: 'the dashboard', open: ['#dashboard-open'] },
    seen: ['dashboard', 'estop', 'estop-release'],
  },
  {
    ...{
      state: 'two-sensors',
      what: 'the colours of clouds, from above',
      open: ['#colours-open', '#from-above'],
    },
    seen: ['estop'],
  },
  { state: 'commands', what: 'the commands', open: ['#commands summary'], seen: ['estop'] },
  { state: 'live', what: 'the first drive', open: ['#help-open', '#tour-start'], seen: ['tour', 'estop'] },
  {
    state: 'stop-latched',
    what: 'the first drive',
    open: ['#help-open', '#tour-start'],
    seen: ['tour', 'estop', 'estop-release', 'stop-band'],
  },
  { state: 'videos', what: 'the first drive', open: ['#help-open', '#tour-start'], seen: ['tour', 'estop'] },
  {
    state: 'everything',
    what: 'the first drive',
    open: ['#help-open', '#tour-start'],
    // On a phone there is no room for the first drive itself.
    seen: ['estop', 'estop-release'],
  },
  { state: 'videos', what: 'what became of the frames', open: ['.video-report button'], seen: ['estop'] },
];
/** When a state has come about, ms: at once, or after a path has been silent. */
const SETTLED_MS = 1000;
const LATE: Partial<Record<StageStateName, number>> = {
  'stop-unconfirmed': 2500,
  'path-lost': 2500,
  'robot-lost': 2500,
  'link-lost': 2500,
  'taken-over': 1500,
  'two-sensors': 1500,
  // Until the notice on connecting has gone: on a phone it lies over the pictures, and is only read.
  videos: 7000,
};

/** Changed in this order, as when a window is moved to another screen, and a tablet's keyboard is taken off. */
const SCREENS = [
  { width: 1280, height: 720, isTouched: false },
  { width: 3840, height: 2160, isTouched: false },
  { width: 360, height: 740, isTouched: true },
  // A phone held sideways, and a laptop at 200 and 400 %.
  { width: 667, height: 320, isTouched: true },
  { width: 640, height: 360, isTouched: false },
  { width: 320, height: 180, isTouched: false },
] as const;
/** On a phone the figures are one line that opens with what is below it. */
function onPhone(id: string): readonly string[] {
  if (id === 'facts') return ['facts-fold'];
  return id === 'people' || id === 'commands' ? [] : [id];
}
/** On less, something of a state may open only when it is asked for, pixels. */
const LOW = 481;
const closed = Object.entries(STATES) as [StageStateName, readonly string[]][];
const rows = [
  ...closed.map(([state, seen]) => ({ state, what: '', open: [] as readonly string[], seen })),
  ...OPENED,
];
test('STOP grows with the screen, and stays in its corner', async ({ stage }) => {
  const page = await stage.open({ state: 'live', canvas: '64x36' });
  for (const [width, height, least] of [
    [3840, 2160, 156],
    [1280, 720, 104],
    [360, 740, 104],
    [667, 320, 84],
    [320, 180, 64],
  ] as const) {
    await stage.resize(width, height);
    const box = (await page.locator('#estop').boundingBox())!;
    const on = `on ${width} × ${height}`;
    expect(box.width, on).toBeGreaterThanOrEqual(least);
    expect([width - box.x - box.width, height - box.y - box.height], on).toEqual([18, 18]);
  }
});

for (const { state, what, open, seen } of rows) {
  test(`nothing covers anything: ${state}${what === '' ? '' : ` with ${what}`}`, async ({ stage }) => {
    const page = await stage.open({ state, canvas: '64x36', forMs: LATE[state] ?? SETTLED_MS });
    for (const [i, { width, height, isTouched }] of SCREENS.entries()) {
      await stage.touched(isTouched);
      await stage.resize(width, height);
      if (i === 0) for (const each of open) await page.locator(each).click();
      await stage.run(300);
      // The code of a panel may be loaded only now.
      const shown = height < LOW ? [] : isTouched ? seen.flatMap(onPhone) : seen;
      for (const id of shown) await page.locator(`#${id}`).waitFor();
      const on = `${state} on ${width} × ${height}`;
      const found = await expectNothingCovered(page, on, open.length > 0);
      // Whatever else is on the screen, STOP is found, and with it that nothing is above it.
      const stop = (await stage.state()).session === 'live' ? ['estop'] : [];
      expect(found, on).toEqual(expect.arrayContaining([...shown, ...stop]));
    }
  });
}

/** German words are longer: three states that have much to say, on the smallest and the usual screen. */
test.describe('in German', () => {
  test.use({ locale: 'de-DE' });
  for (const state of ['driving', 'stop-latched', 'everything'] as const) {
    test(`nothing covers anything in German: ${state}`, async ({ stage }) => {
      const page = await stage.open({ state, canvas: '64x36', forMs: SETTLED_MS });
      for (const { width, height, isTouched } of [SCREENS[0], SCREENS[2]]) {
        await stage.touched(isTouched);
        await stage.resize(width, height);
        await stage.run(300);
        const on = `${state} in German on ${width} × ${height}`;
        const shown = isTouched ? STATES[state].flatMap(onPhone) : STATES[state];
        const found = await expectNothingCovered(page, on);
        await page.locator('#estop').click({ trial: true });
        expect(found, on).toEqual(expect.arrayContaining([...shown]));
      }
    });
  }
});
