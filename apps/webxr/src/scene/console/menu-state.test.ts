import { signal } from '@preact/signals-core';
import { beforeEach, expect, test } from 'vitest';
import type { ConsoleActions } from './console-actions.ts';
import type { MenuFacts } from './menu-page.ts';
import { MenuState } from './menu-state.ts';

const robot = (n: number) => ({ id: `r${n}`, name: `Robot ${n}` });
const live: MenuFacts = {
  live: true,
  heard: true,
  latched: false,
  robots: [robot(1), robot(2)],
  noRobots: 'No robots are online.',
  chosenRobotId: 'r1',
  holder: 'you',
  mayTake: false,
  mayAsk: false,
  asked: null,
  own: null,
  hasHeirs: false,
  heirs: [],
  view: 'first-person',
  cameras: [{ name: 'Front', shown: 'shown' }],
  commands: { groups: [], recording: null },
  mayPoint: false,
  readings: [],
  times: { clouds: [{ text: 'Clouds: 90 ms', tone: 'neutral' }], commands: [] },
  passthrough: false,
};

let done: string[];
const facts = signal(live);
let menu: MenuState;
/** Later than anything before, ms. */
let nowMs = 0;
beforeEach(() => {
  done = [];
  facts.value = live;
  const actions = new Proxy({} as ConsoleActions, {
    get:
      (_, name) =>
      (...given: unknown[]) =>
        void done.push([name, ...given].join(' ')),
  });
  menu = new MenuState(facts, actions);
  menu.open();
});

const texts = () => menu.page.value?.items.map(({ text }) => text) ?? null;
/** A ray that rests on the entry, and a trigger, long after the last change. */
function choose(text: string): void {
  const row = texts()?.indexOf(text) ?? -1;
  expect(row, text).toBeGreaterThanOrEqual(0);
  menu.update(nowMs);
  nowMs += 1000;
  menu.mark(row);
  menu.choose(row, nowMs);
}

test('what the page can do is in it, STOP first, and nothing is marked that stops by accident', () => {
  expect(texts()).toEqual([
    'STOP the robot',
    'Robots ›',
    'Give up the drive',
    'View: first person ›',
    'Cameras ›',
    'Readings ›',
    'Where the time goes ›',
    'Recentre',
    'Disconnect',
    'Leave VR',
    'Close the menu',
  ]);
  expect(menu.marked.value).toBe(-1);
  menu.step(1);
  expect(texts()?.[menu.marked.value]).toBe('Robots ›');
});

test('an entry does what it says and closes the menu; one whose work is seen beside it stays open', () => {
  for (const [entry, does] of [
    ['Leave VR', 'leave'],
    ['Recentre', 'recentre'],
    ['Disconnect', 'disconnect'],
    ['STOP the robot', 'stop'],
    ['Give up the drive', 'giveUp'],
  ] as const) {
    menu.open();
    choose(entry);
    expect([done.at(-1), menu.isOpen.value]).toEqual([does, false]);
  }
  facts.value = { ...live, mayPoint: true };
  menu.open();
  choose('Point at the floor');
  expect([done.at(-1), menu.isOpen.value]).toEqual(['pointAtFloor', false]);
  menu.open();
  choose('View: first person ›');
  choose('tabletop');
  expect([done.at(-1), menu.isOpen.value]).toEqual(['show tabletop', false]);
  menu.open();
  choose('Where the time goes ›');
  expect(texts()).toEqual(['Latency test', 'Clouds: 90 ms', 'Commands ›', '‹ Back']);
  choose('Latency test');
  expect(done.at(-1)).toBe('testLatency');
  menu.open();
  choose('Cameras ›');
  choose('Front: at the wrist ›');
  choose('Enlarge');
  choose('In place of the cloud');
  choose('Hide');
  expect(done.slice(-3)).toEqual(['enlarge 0', 'fill 0', 'toggleCamera 0']);
  expect(menu.isOpen.value).toBe(true);
  choose('‹ Back');
  choose('‹ Back');
  expect(menu.page.value?.title).toBe('Menu');
});

test('another robot is chosen from the list, which goes on over further pages and begins anew', () => {
  facts.value = { ...live, robots: Array.from({ length: 8 }, (_, n) => robot(n + 1)) };
  choose('Robots ›');
  expect(texts()).toHaveLength(8);
  expect(menu.page.value?.items[0]).toMatchObject({ text: 'Robot 1 (chosen)', choice: null });
  choose('More ›');
  expect(texts()?.slice(0, 2)).toEqual(['Robot 7', 'Robot 8']);
  choose('Robot 8');
  expect([done, menu.isOpen.value]).toEqual([['choose r8'], true]);
  choose('More ›');
  expect(texts()?.[0]).toBe('Robot 1 (chosen)');
});

test('without a robot it says why, and has neither STOP nor the drive', () => {
  facts.value = { ...live, live: false, chosenRobotId: null, robots: [], holder: 'nobody' };
  expect(texts()).toEqual([
    'Robots ›',
    'View: first person ›',
    'Cameras ›',
    'Recentre',
    'Leave VR',
    'Close the menu',
  ]);
  choose('Robots ›');
  expect(texts()).toEqual(['No robots are online.', '‹ Back']);
  facts.value = { ...facts.value, chosenRobotId: 'gone' };
  expect(texts()).toContain('gone (offline)');
});

test('who drives hands over to a named operator or gives up; who does not takes over or asks', () => {
  facts.value = { ...live, hasHeirs: true, heirs: [{ number: 3, text: 'Bo (may drive)' }] };
  choose('Hand over ›');
  choose('Offer it to Bo (may drive)');
  expect(done).toEqual(['offerDrive 3']);
  facts.value = { ...live, holder: 'other', mayTake: true, mayAsk: true };
  menu.open();
  choose('Ask to drive');
  menu.open();
  choose('Take over');
  expect(done.slice(1)).toEqual(['askToDrive', 'takeOver']);
});

test('a request is answered, and an own one taken back, while the robot hears', () => {
  const asked = { id: 7, text: 'Bo asks to drive (9 s)', accept: 'Give the drive', refuse: 'Refuse' };
  facts.value = { ...live, asked, own: { id: 8, text: 'You have asked Bo' } };
  choose('Give the drive');
  menu.open();
  choose('Refuse');
  menu.open();
  choose('Take it back');
  expect(done).toEqual(['answer 7 true', 'answer 7 false', 'withdraw 8']);
  facts.value = { ...facts.value, heard: false };
  menu.open();
  expect(texts()).not.toContain('Give the drive');
  expect(texts()).not.toContain('Take it back');
});

test('entries that move by themselves cannot be chosen for half a second', () => {
  menu.mark(1);
  menu.choose(null, nowMs);
  facts.value = {
    ...live,
    asked: { id: 7, text: 'Bo asks', accept: 'Give the drive', refuse: 'Refuse' },
  };
  nowMs += 10_000;
  menu.update(nowMs);
  const row = texts()?.indexOf('Give the drive') ?? -1;
  menu.mark(row);
  menu.choose(row, nowMs + 499);
  expect(done).toEqual([]);
  // STOP does not wait.
  menu.choose(0, nowMs + 1);
  expect(done.splice(0)).toEqual(['stop']);
  menu.open();
  menu.mark(row);
  // Time that runs down moves nothing.
  facts.value = {
    ...facts.value,
    asked: { id: 7, text: 'Bo asks!', accept: 'Give the drive', refuse: 'Refuse' },
  };
  menu.choose(row, nowMs + 500);
  expect(done).toEqual(['answer 7 true']);
});

test('the stick moves the mark over what can be chosen, and the trigger chooses it wherever the ray rests', () => {
  menu.mark(8);
  menu.step(1);
  expect(menu.marked.value).toBe(9);
  menu.choose(8, nowMs);
  expect(done).toEqual(['leave']);
  menu.open();
  // A ray that is nowhere chooses nothing by itself.
  menu.choose(null, nowMs);
  expect([menu.isOpen.value, menu.marked.value]).toEqual([true, -1]);
  menu.step(1);
  // A ray that leaves the menu leaves the stick’s mark, but not its own.
  menu.mark(-1);
  expect(menu.marked.value).toBe(1);
  menu.step(-1);
  menu.choose(null, nowMs);
  expect(done.at(-1)).toBe('stop');
  menu.open();
  menu.mark(3);
  menu.mark(-1);
  expect(menu.marked.value).toBe(-1);
  menu.mark(0);
  menu.step(-1);
  expect(texts()?.[menu.marked.value]).toBe('Close the menu');
  // On the next page, the first entry is chosen without a further step.
  menu.open();
  menu.mark(0);
  menu.step(1);
  menu.choose(null, nowMs);
  expect(menu.page.value?.title).toBe('Robots');
  menu.choose(null, nowMs);
  expect(done.at(-1)).toBe('choose r2');
});

test('the robot’s commands are a page of the menu that stays open, where the robot has any', () => {
  expect(texts()).not.toContain('Commands ›');
  const dock = { id: 'dock', text: 'Dock', note: '', state: 'free', progress: null, cancel: null } as const;
  const lights = { ...dock, id: 'lights', text: 'Lights' };
  const offer = (shown: object) => {
    const groups = [{ name: '', commands: [{ ...dock, ...shown }, lights] }];
    facts.value = { ...live, commands: { groups, recording: null } };
  };
  offer({});
  choose('Commands ›');
  expect([menu.page.value?.title, texts()]).toEqual(['Commands', ['Dock', 'Lights', '‹ Back']]);
  choose('Dock');
  expect([done, menu.isOpen.value]).toEqual([['pressCommand dock'], true]);
  offer({ text: 'Press again: Dock', state: 'armed' });
  choose('Press again: Dock');
  offer({ state: 'running', cancel: 'Cancel: Dock' });
  menu.update(nowMs);
  // A trigger that is pulled twice does not cancel what it has begun.
  menu.choose(0, nowMs + 499);
  expect(done).toEqual(['pressCommand dock', 'pressCommand dock']);
  // What the robot says of it moves nothing.
  offer({ state: 'running', cancel: 'Cancel: Dock', note: 'turning' });
  menu.choose(0, nowMs + 500);
  expect(done.at(-1)).toBe('cancelCommand dock');
});

test('no page has more rows than the menu shows, with two rows of each text', () => {
  const many = Array.from({ length: 30 }, (_, n) => robot(n));
  facts.value = {
    ...live,
    robots: many,
    cameras: many.map(({ name }) => ({ name, shown: 'shown' as const })),
    readings: many.map(({ name }) => ({ text: name, tone: 'neutral' as const })),
    heirs: many.map(({ name }, number) => ({ number, text: name })),
    hasHeirs: true,
    commands: { groups: [{ name: 'A', commands: [] }], recording: null },
    mayPoint: true,
  };
  for (const page of ['robots', 'cameras', 'readings', 'people'] as const) {
    menu.show({ page, first: 0 });
    expect(2 * 6 + (texts()?.length ?? 0) - 6).toBeLessThanOrEqual(15);
  }
  const asked = { id: 7, text: 'Bo asks to drive (9 s)', accept: 'Give the drive', refuse: 'Refuse' };
  facts.value = { ...facts.value, asked, own: { id: 8, text: 'You have offered Cy the drive' } };
  menu.open();
  // The title, and two rows of each question.
  expect(1 + (texts()?.length ?? 0) + 2).toBeLessThanOrEqual(20);
});
