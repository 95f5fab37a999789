import type { RobotClient } from '@farpoint/operator';
import type { Handover } from '@farpoint/protocol';
import { type Signal, signal } from '@preact/signals-core';
import { beforeEach, expect, test } from 'vitest';
import { EventLog } from '../../ground/events/event-log.ts';
import { Switches } from '../../ground/switches.ts';
import { laterEnglish } from '../../words/en/later-catalogue.ts';
import { eventText } from '../../words/event-words.ts';
import { StopNews } from '../stop-news.ts';
import { type EventSources, feedEvents } from './feed-events.ts';

/** A page whose client and state a test moves. */
function setUp() {
  const clock = { ms: 10_000 };
  const listeners = new Map<string, ((event: unknown) => void)[]>();
  const session = {
    welcome: null as unknown,
    estopCause: null as unknown,
    operators: null as unknown,
    lease: { holder: 'other' },
  };
  const client = {
    on: (type: string, listener: (event: unknown) => void) =>
      listeners.set(type, [...(listeners.get(type) ?? []), listener]),
    link: { session, lossDetail: null as string | null, silentMs: () => 700 },
  };
  const link = {
    chosenRobotId: signal<string | null>(null),
    signaling: signal('connecting'),
    live: signal(false),
    silence: signal('heard'),
  };
  const robot = { about: signal<{ recorded: boolean } | null>(null) };
  const notices = { failure: signal<{ title: string; text: string } | null>(null), tell: () => undefined };
  const [cameras, videos, sensors] = [new Switches(), new Switches(), new Switches()];
  const figures = signal({ lossRate: 0 });
  const stopNews = new StopNews(client as unknown as RobotClient, notices);
  const settings = { cues: signal(true) };
  const log = new EventLog(() => clock.ms);
  const state = { link, robot, notices, stopNews, figures, cameras, sensors, videos: { switches: videos } };
  feedEvents({
    log,
    client: client as unknown as RobotClient,
    state: state as unknown as EventSources['state'],
    settings: { cues: () => settings.cues.value },
    operator: 'Ann',
    now: () => clock.ms,
  });
  let seen = 0;
  /** What has been added since the last call, in English. */
  const news = () => {
    const { events } = log.kept;
    const said = events
      .slice(seen)
      .map(({ robot: about, detail }) => `${about}: ${eventText(detail, laterEnglish)}`);
    seen = events.length;
    return said;
  };
  const emit = (type: string, event?: unknown) => {
    if (type === 'welcome') session.welcome = event;
    for (const listener of listeners.get(type) ?? []) listener(event);
  };
  return {
    clock,
    client,
    session,
    link,
    robot,
    notices,
    cameras,
    figures,
    stopNews,
    settings,
    log,
    news,
    emit,
  };
}

let page: ReturnType<typeof setUp>;
beforeEach(() => {
  page = setUp();
  page.link.chosenRobotId.value = 'rover-1';
  page.emit('session', 1);
  page.link.live.value = true;
  page.emit('welcome', { robotId: 'rover-1', name: 'Rover' });
  page.news();
});

test('sessions begin and end, with the time within them', () => {
  const { clock, link, client, log, news, emit } = setUp();
  link.signaling.value = 'ready';
  link.chosenRobotId.value = 'rover-1';
  link.live.value = true;
  emit('welcome', { robotId: 'rover-1', name: 'Rover', access: { name: 'Ann Smith' } });
  clock.ms += 1500;
  emit('path', false);
  client.link.lossDetail = 'gone';
  emit('loss', 'robot-stopped');
  emit('phase', 'waiting');
  link.chosenRobotId.value = 'rover-2';
  link.chosenRobotId.value = null;
  const timesMs = log.kept.events.map(({ sessionMs }) => sessionMs);
  expect(timesMs).toEqual([null, null, null, 0, 1500, 1500, null, null, null]);
  expect(news()).toEqual([
    'null: The page was opened.',
    'null: Connected to the signaling service.',
    'rover-1: Robot chosen: rover-1.',
    'Rover: Session with Rover began; operator: Ann Smith.',
    'Rover: The network path to the robot was lost.',
    'Rover: Session ended: the robot was shut down (gone).',
    'Rover: Disconnected from rover-1.',
    'rover-2: Robot chosen: rover-2.',
    'rover-2: Disconnected from rover-2.',
  ]);
});

test('a silence, and how long it was', () => {
  const { clock, link, news } = page;
  link.silence.value = 'unheard';
  link.silence.value = 'lost';
  clock.ms += 1300;
  link.silence.value = 'unheard';
  link.silence.value = 'heard';
  expect(news()).toEqual([
    'Rover: Nothing is heard from the robot.',
    'Rover: The robot is heard again after 2.0 s.',
  ]);
  // Without a session nothing is silent.
  link.live.value = false;
  link.silence.value = 'lost';
  expect(news()).toEqual([]);
});

test('who drives, when it changes', () => {
  const { news, emit } = page;
  emit('lease', { holder: 'nobody' });
  emit('lease', { holder: 'you', lease: 'a' });
  emit('lease', { holder: 'you', lease: 'a' });
  emit('lease', { holder: 'other', driver: 'Bo' });
  const handover = { kind: 'offer', from: { name: 'Bo' }, to: { name: 'Ann' } } as Handover;
  emit('handover', { ...handover, leftMs: 1000 });
  emit('handover', { ...handover, ended: 'refused' });
  emit('gripLost', 'other-drives');
  expect(news()).toEqual([
    'Rover: You have the drive.',
    'Rover: Bo drives.',
    'Rover: Bo offered the drive to Ann: refused.',
    'Rover: The grip no longer counts: someone else drove.',
  ]);
});

test('refusals are counted, as often as the robot says', () => {
  const { log, emit } = page;
  emit('commandRejected', { reason: 'stale', detail: '', count: 4 });
  emit('commandRejected', { reason: 'stale', detail: '', count: 8 });
  expect(log.kept.events.at(-1)).toMatchObject({ times: 12, detail: { kind: 'command-refused' } });
});

test('STOP: by whom it was pressed and released', () => {
  const { session, stopNews, news, emit } = page;
  emit('estop', { latched: false, latch: 0 });
  session.estopCause = { latch: 1, pressedBy: 'Bo', yours: false, release: 'driver' };
  emit('estop', { latched: true, by: 'operator', latch: 1 });
  emit('estop', { latched: true, by: 'operator', latch: 1 });
  session.operators = { operators: [{ name: 'Bo', role: 'drive', drives: true, you: false }] };
  emit('estop', { latched: false, latch: 1 });
  session.estopCause = { latch: 2, pressedBy: 'Ann', yours: true, release: 'driver' };
  emit('stop', 'confirmed');
  emit('stop', 'none');
  emit('estop', { latched: true, by: 'operator', latch: 2 });
  stopNews.onOwnRelease();
  emit('estop', { latched: false, latch: 2 });
  session.estopCause = { latch: 3, yours: false, heldBy: ['gpio'], release: 'driver' };
  emit('estop', { latched: true, by: 'robot', releasedAt: 'robot', latch: 3 });
  emit('estop', { latched: false, latch: 3 });
  expect(news()).toEqual([
    'Rover: Emergency stop by Bo.',
    'Rover: The emergency stop was released by Bo.',
    'Rover: The robot confirmed STOP.',
    'Rover: Emergency stop by you.',
    'Rover: The emergency stop was released by you.',
    'Rover: Emergency stop by a stop button on the robot.',
    'Rover: The emergency stop was released at the robot.',
  ]);
  emit('session', 2);
  emit('estop', { latched: true, by: 'robot', latch: 3 });
  expect(news()).toEqual(['Rover: Emergency stop by a stop button on the robot (when the session began).']);
});

test('what the robot reports, what the page cannot do, and what the operator switches', () => {
  const { robot, notices, cameras, settings, news, emit } = page;
  const alarm = { number: 0, text: 'Hot', value: 91, limit: 80, unit: '°C', sinceMs: 0 };
  emit('alarm', { ...alarm, level: 'error' });
  emit('alarm', { ...alarm, level: 'ok', value: 70 });
  emit('latency', { mtpMs: 80.4, firstMs: 60 });
  emit('robotFault', 'cannot');
  robot.about.value = { recorded: true };
  robot.about.value = { recorded: false };
  notices.failure.value = { title: 'The graphics system was reset', text: 'Wait.' };
  cameras.set([{ name: 'Front' }, { name: 'Rear' }]);
  cameras.toggle(1);
  cameras.set([]);
  cameras.set([{ name: 'Front' }, { name: 'Rear' }]);
  settings.cues.value = false;
  expect(news()).toEqual([
    'Rover: Alarm: Hot (91 °C, limit 80 °C)',
    'Rover: Alarm cleared: Hot (70 °C, limit 80 °C)',
    'Rover: Motion to photon: 80 ms (first points 60 ms).',
    'Rover: The robot reports: cannot',
    'Rover: The robot records this session.',
    'Rover: The robot no longer records this session.',
    'Rover: Error on this page: The graphics system was reset. Wait.',
    'Rover: Camera Rear: off.',
    'Rover: Sound and vibration: off.',
  ]);
});

test('a poor link and a robot that is held, as it reports them; a new session begins anew', () => {
  const { figures, news, emit } = page;
  (figures as Signal<{ lossRate: number }>).value = { lossRate: 0.1 };
  const telemetry = (timeMs: number) => ({
    timeMs,
    drive: 'driving',
    motion: { factor: 0, reasons: ['obstacle'] },
    stream: { targetBitsPerSecond: 1e6 },
  });
  emit('telemetry', telemetry(50));
  emit('telemetry', telemetry(100));
  expect(news()).toEqual([
    'Rover: Packet loss: 10 %.',
    'Rover: The robot holds itself: an obstacle is in the way.',
  ]);
  emit('session', 2);
  emit('telemetry', telemetry(10));
  expect(page.log.kept.events.at(-1)?.times).toBe(2);
});
