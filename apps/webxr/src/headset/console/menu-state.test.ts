import { signal } from '@preact/signals-core';
import { beforeEach, expect, test } from 'vitest';
import type { ConsoleActions } from './console-actions.ts';
import { ENTRIES_A_PAGE, type MenuFacts } from './menu-page.ts';
import { MenuState } from './menu-state.ts';

type Facts = Omit<MenuFacts, 'page' | 'first'>;
const robot = (n: number) => ({ id: `r${n}`, name: `Robot ${n}` });
const live: Facts = {
  ...{ link: 'Live', live: true, latched: false, robots: [robot(1), robot(2)], chosenRobotId: 'r1' },
  ...{
    holder: 'you',
    mayTake: false,
    asked: null,
    mayAsk: false,
    offerable: [],
    waiting: null,
    view: 'first-person',
    readings: true,
    passthrough: false,
  },
  cameras: [{ kind: 'video', index: 0, name: 'front', on: true }],
  commands: [],
};

let done: string[];
const facts = signal(live);
let menu: MenuState;
beforeEach(() => {
  done = [];
  facts.value = live;
  const actions = new Proxy({} as ConsoleActions, {
    get: (_, name) => (given: unknown) =>
      void done.push([name, given].filter((x) => x !== undefined).join(' ')),
  });
  menu = new MenuState(facts, actions);
});

const texts = () => menu.page.value?.items.map(({ text }) => text) ?? null;
const choose = (text: string) => menu.choose(texts()?.indexOf(text));

test('everything that the page can do is on it, STOP first, and nothing is marked that stops by accident', () => {
  expect(texts()).toBeNull();
  menu.open('main');
  expect(texts()).toEqual([
    'STOP the robot',
    'Change robot…',
    'View: first person',
    'Cameras…',
    'Readings on the wrist: all',
    'Hand back the drive',
    'Latency test',
    'Recentre',
    'Leave VR',
    'Close this menu',
  ]);
  expect(menu.marked.value).toBe(1);
});

test('a choice is done, and the menu closes; a switch stays open', () => {
  menu.open('main');
  choose('Readings on the wrist: all');
  expect([done, menu.isOpen.value]).toEqual([['toggleReadings'], true]);
  choose('Leave VR');
  expect([done.at(-1), menu.isOpen.value]).toEqual(['leave', false]);
  menu.open('main');
  choose('View: first person');
  choose('Tabletop');
  expect([done.at(-1), menu.isOpen.value]).toEqual(['show tabletop', false]);
  menu.open('cameras');
  choose('front: shown');
  expect([done.at(-1), menu.isOpen.value]).toEqual(['toggleVideo 0', true]);
  menu.open('main');
  choose('STOP the robot');
  expect([done.at(-1), menu.isOpen.value]).toEqual(['stop', false]);
});

test('the drive is offered as it can be had', () => {
  menu.open('main');
  facts.value = { ...live, holder: 'other', mayTake: true };
  expect(texts()).toContain('Take over the drive');
  choose('Take over the drive');
  expect(done).toEqual(['takeOver']);
  facts.value = { ...live, holder: 'nobody', mayTake: false };
  menu.open('main');
  expect(texts()?.filter((text) => text.includes('the drive'))).toEqual([]);
});

test('without a robot it says so and lists those that come; the list goes on over further pages', () => {
  facts.value = { ...live, live: false, chosenRobotId: null, robots: [], link: 'Signaling connected' };
  menu.open('robots');
  expect(texts()).toEqual([
    'Signaling connected',
    'No robot is here yet. It appears as soon as it is.',
    'Back',
  ]);
  // What only says something cannot be chosen.
  menu.choose(0);
  expect([menu.marked.value, done]).toEqual([2, []]);
  facts.value = { ...facts.value, robots: Array.from({ length: ENTRIES_A_PAGE + 2 }, (_, n) => robot(n)) };
  expect(texts()).toHaveLength(ENTRIES_A_PAGE + 3);
  choose('More robots…');
  expect(texts()).toContain(`Robot ${ENTRIES_A_PAGE + 1}`);
  choose('More robots…');
  choose('Robot 0');
  expect([done, menu.isOpen.value]).toEqual([['choose r0'], false]);
});

test('a mark steps over what cannot be chosen, round and round', () => {
  facts.value = { ...live, chosenRobotId: null };
  menu.open('robots');
  const marked = () => texts()?.[menu.marked.value];
  expect(marked()).toBe('Robot 1');
  menu.step(-1);
  expect(marked()).toBe('Back');
  menu.step(1);
  menu.step(1);
  expect(marked()).toBe('Robot 2');
  menu.choose();
  expect(done).toEqual(['choose r2']);
});

test('a mark stays on the page when the page becomes shorter', () => {
  menu.open('main');
  menu.mark(9);
  facts.value = { ...live, live: false };
  expect(texts()?.[menu.marked.value]).toBe('Close this menu');
});

test('the robot’s commands are given from it, and it stays open for the second press', () => {
  const command = (n: number, change: object = {}) => ({
    ...{ id: `c${n}`, text: `Command ${n}`, bar: null, armed: false, ...change },
  });
  facts.value = {
    ...live,
    commands: [command(1), command(2, { bar: 'estop' }), command(3, { armed: true })],
  };
  menu.open('main');
  choose('Robot commands…');
  expect(texts()).toEqual([
    ...['Command 1', 'Command 2: not while the emergency stop is on', 'Command 3', 'Back'],
  ]);
  choose('Command 1');
  choose('Command 2: not while the emergency stop is on');
  expect([done, menu.isOpen.value]).toEqual([['pressCommand c1'], true]);
  facts.value = { ...live, commands: Array.from({ length: 8 }, (_, n) => command(n)) };
  choose('More commands…');
  expect(texts()).toEqual(['Command 6', 'Command 7', 'More commands…', 'Back']);
});

test('another operator’s request is answered there, before anything but STOP', () => {
  facts.value = {
    ...live,
    asked: { id: 7, accept: 'Give the drive to Bob', refuse: 'Refuse Bob the drive' },
  };
  menu.open('main');
  expect(texts()?.slice(0, 3)).toEqual(['STOP the robot', 'Give the drive to Bob', 'Refuse Bob the drive']);
  choose('Refuse Bob the drive');
  facts.value = { ...live, holder: 'other', mayTake: true, mayAsk: true };
  menu.open('main');
  choose('Ask to drive');
  expect(done).toEqual(['answer 7', 'askToDrive']);
});

test('the drive is offered to somebody who is here, and the offer is taken back', () => {
  const people = Array.from({ length: ENTRIES_A_PAGE + 1 }, (_, i) => ({
    number: i + 10,
    text: `Operator ${i} (may drive)`,
  }));
  facts.value = { ...live, offerable: people };
  menu.open('main');
  expect(texts()?.slice(0, 2)).toEqual(['STOP the robot', 'Offer the drive…']);
  choose('Offer the drive…');
  expect(menu.page.value?.title).toBe('Offer the drive to');
  expect(texts()).toHaveLength(ENTRIES_A_PAGE + 2);
  choose('More people…');
  choose(`Operator ${ENTRIES_A_PAGE} (may drive)`);
  expect(done).toEqual([`offerDrive ${ENTRIES_A_PAGE + 10}`]);
  expect(menu.isOpen.value).toBe(false);

  // Nobody else is offered it while one is asked.
  facts.value = { ...live, waiting: { id: 7, takeBack: 'Take back the offer to Ann' } };
  menu.open('main');
  expect(texts()?.slice(0, 3)).toEqual(['STOP the robot', 'Take back the offer to Ann', 'Change robot…']);
  choose('Take back the offer to Ann');
  expect(done).toEqual([`offerDrive ${ENTRIES_A_PAGE + 10}`, 'withdraw 7']);

  // They have left while the page was open.
  facts.value = { ...live, offerable: people };
  menu.open('people');
  facts.value = live;
  expect(texts()).toEqual(['Nobody is here who may drive.', 'Back']);
});
