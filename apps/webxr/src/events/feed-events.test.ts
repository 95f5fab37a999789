import type { Alarm, RobotClient } from '@farpoint/operator';
import { type Signal, signal } from '@preact/signals-core';
import { beforeEach, expect, test } from 'vitest';
import { Notices } from '../state/notices.ts';
import type { Words } from '../status/words.ts';
import { EventLog } from './event-log.ts';
import { type FedState, feedEvents } from './feed-events.ts';

const nobody: Words = { text: 'Nobody is driving', tone: 'neutral' };

/** The page's state as signals that a test sets. */
function setUp() {
  const notices = new Notices();
  const events = new EventLog(() => 0);
  const link = {
    ...{ chosenRobotId: signal<string | null>(null), ready: signal(true), live: signal(false) },
    ...{ banner: signal<{ urgent: boolean } | null>(null), obstacle: signal(null) },
  };
  const robot = {
    ...{ name: signal<string | null>(null), heard: signal(true), afterGap: signal('resume') },
    ...{ stop: signal('none'), latchedStop: signal<{ why: string } | null>(null) },
    ...{ motion: signal<Words | null>(null), obstacleGuard: signal<Words | null>(null) },
    telemetry: signal<{ drive: string } | null>(null),
    about: signal<{ recorded: boolean } | null>(null),
  };
  const driving = { driver: signal(nobody) };
  const latency = { entries: signal<readonly object[]>([]) };
  const alarms: ((alarm: Alarm) => void)[] = [];
  const client = { on: (_: string, listener: (alarm: Alarm) => void) => alarms.push(listener) };
  const state = { events, link, robot, driving, notices, latency };
  feedEvents(state as unknown as FedState, client as unknown as RobotClient);
  /** What has been added since this was called last. */
  let seen = 0;
  const news = () => {
    const { events: all } = events.kept.value;
    const texts = all.slice(seen).map(({ severity, robot: about, text }) => `${severity} ${about}: ${text}`);
    seen = all.length;
    return texts;
  };
  const live = (name: string) => {
    link.chosenRobotId.value = name.toLowerCase();
    robot.name.value = name;
    link.live.value = true;
  };
  return { notices, link, robot, driving, latency, alarms, news, live };
}

let page: ReturnType<typeof setUp>;
beforeEach(() => {
  page = setUp();
  page.live('Rover');
  page.news();
});

test('what has been is not news; robots that are chosen and left are', () => {
  const fresh = setUp();
  expect(fresh.news()).toEqual(['info null: This page was opened']);
  fresh.link.chosenRobotId.value = 'sim-1';
  expect(fresh.news()).toEqual(['info sim-1: Robot chosen: sim-1']);
  fresh.link.chosenRobotId.value = null;
  expect(fresh.news()).toEqual(['info sim-1: Disconnected']);
});

test('notices with their tone, and a latency test once', () => {
  const { notices, latency, news } = page;
  notices.tell('The robot refused a speed above its limits.', 'warning');
  latency.entries.value = [{ report: { mtpMs: 80.4, firstMs: 60 }, failure: null }];
  notices.tell('Motion to photon 80 ms (first points 60 ms)', 'good');
  latency.entries.value = [{ report: null, failure: 'no-session' }];
  notices.failure.value = { title: 'The graphics system was reset', text: 'Wait.' };
  expect(news()).toEqual([
    'warning Rover: The robot refused a speed above its limits.',
    'info Rover: Motion to photon 80 ms (first points 60 ms)',
    'warning Rover: Connect to a robot first.',
    'error Rover: The graphics system was reset. Wait.',
  ]);
});

test('a link that falls silent and comes back; one that is given up is told of by its loss', () => {
  const { link, news } = page;
  link.banner.value = { urgent: true };
  link.banner.value = null;
  expect(news()).toEqual([
    'error Rover: Connection lost: nothing is heard of the robot',
    'info Rover: The robot is heard again',
  ]);
  // A hand that holds on in vain has a banner, too.
  link.banner.value = { urgent: false };
  expect(news()).toEqual([]);
  link.live.value = false;
  link.banner.value = { urgent: true };
  link.ready.value = false;
  expect(news()).toEqual(['warning null: Cannot reach the signaling service. Trying again…']);
});

test('who drives while there is a session', () => {
  const { driving, link, news } = page;
  driving.driver.value = { text: 'Ann is driving', tone: 'warning' };
  driving.driver.value = { text: 'You have control', tone: 'good' };
  expect(news()).toEqual(['warning Rover: Ann is driving', 'info Rover: You have control']);
  link.live.value = false;
  driving.driver.value = nobody;
  link.live.value = true;
  expect(news()).toEqual([]);
});

test('STOP: who set it, whether this page’s own arrived, and that it is off', () => {
  const { robot, link, news } = page;
  robot.stop.value = 'unconfirmed';
  robot.latchedStop.value = { why: 'You pressed STOP.' };
  robot.stop.value = 'confirmed';
  robot.latchedStop.value = { why: 'You pressed STOP.' };
  robot.latchedStop.value = null;
  expect(news()).toEqual([
    'warning Rover: STOP not yet confirmed',
    'error Rover: Emergency stop: You pressed STOP.',
    'info Rover: STOP confirmed',
    'info Rover: The emergency stop is off',
  ]);
  robot.latchedStop.value = { why: 'Ann pressed STOP.' };
  link.live.value = false;
  robot.latchedStop.value = null;
  expect(news()).toEqual(['error Rover: Emergency stop: Ann pressed STOP.']);
});

test('why the robot is held or slowed, once for each reason', () => {
  const { robot, news } = page;
  const slower = (ms: number) => ({ text: `Slower: what you see is ${ms} ms old`, tone: 'warning' as const });
  for (const ms of [300, 310, 325]) robot.motion.value = slower(ms);
  robot.motion.value = { text: 'Held: something is in the way', tone: 'bad' };
  robot.motion.value = null;
  for (const drive of ['driving', 'blocked', 'blocked', 'idle']) robot.telemetry.value = { drive };
  expect(news()).toEqual([
    'warning Rover: Slower: what you see is 300 ms old',
    'error Rover: Held: something is in the way',
    'warning Rover: Blocked by an obstacle',
  ]);
});

test('recording, and alarms', () => {
  const { robot, alarms, news } = page;
  (robot.about as Signal<object | null>).value = { recorded: true };
  (robot.about as Signal<object | null>).value = { recorded: false };
  const alarm: Alarm = {
    ...{ number: 1, text: 'Motor is hot', value: 91, limit: 80, unit: '°C', sinceMs: 1 },
    ...{ type: 'alarm' as const, level: 'error' as const },
  };
  for (const listener of alarms) {
    listener(alarm);
    listener({ ...alarm, level: 'ok', value: 70 });
  }
  expect(news()).toEqual([
    'warning Rover: This session is being recorded',
    'info Rover: This session is no longer recorded',
    'error Rover: Alarm: Motor is hot (91 °C, limit 80 °C)',
    'info Rover: Over: Motor is hot (70 °C, limit 80 °C)',
  ]);
});
