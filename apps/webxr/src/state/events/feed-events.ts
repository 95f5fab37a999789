/** Adapts what the client and the page's state tell to the event log. */
import type { Alarm, EstopCause, Handover, RobotClient } from '@farpoint/operator';
import { computed, effect, type ReadonlySignal, untracked } from '@preact/signals-core';
import type { EventLog } from '../../ground/events/event-log.ts';
import type { DetailOf, EventDetail } from '../../ground/events/page-event.ts';
import type { Switch } from '../../ground/switches.ts';
import type { PageState } from '../page-state.ts';
import type { StopChange } from '../stop-news.ts';
import { LossEvents } from './loss-events.ts';
import { MotionEvents } from './motion-events.ts';

/** Settings that matter to what the operator sees or hears; each reads a signal. */
export type LoggedSettings = Readonly<Partial<Record<DetailOf<'setting'>['name'], () => boolean>>>;

export interface EventSources {
  readonly log: EventLog;
  readonly client: Pick<RobotClient, 'on' | 'link'>;
  readonly state: Pick<
    PageState,
    'link' | 'robot' | 'notices' | 'stopNews' | 'figures' | 'cameras' | 'videos' | 'sensors'
  >;
  readonly settings: LoggedSettings;
  /** What the operator calls itself, where no grant says. */
  readonly operator: string;
  /** Page's clock, ms. */
  now(): number;
}

/** Adds what has happened, to the robot and session of now. */
export type AddEvent = (detail: EventDetail, times?: number) => void;

/** @returns adds what the page itself has done */
export function feedEvents(sources: EventSources): AddEvent {
  const { log, client, state, now } = sources;
  let beganMs: number | null = null;
  client.on('welcome', () => {
    beganMs = now();
  });
  const add: AddEvent = (detail, times) => {
    // The robot that is left is chosen no longer.
    const chosen = detail.kind === 'robot-left' ? detail.robotId : state.link.chosenRobotId.peek();
    const { welcome } = client.link.session;
    const robot = welcome !== null && welcome.robotId === chosen ? welcome.name : chosen;
    log.add(detail, { robot, sessionMs: beganMs === null ? null : now() - beganMs }, times);
  };
  feedConnection(sources, add);
  client.on('phase', (phase) => {
    if (phase !== 'live') beganMs = null;
  });
  feedLink(sources, add);
  feedDriving(client, add);
  feedStop(sources, add);
  feedReports(sources, add);
  feedChoices(sources, add);
  return add;
}

function feedConnection({ client, state, operator }: EventSources, add: AddEvent): void {
  add({ kind: 'page-opened' });
  onChange(state.link.chosenRobotId, (id, before) => {
    if (before !== null) add({ kind: 'robot-left', robotId: before });
    if (id !== null) add({ kind: 'robot-chosen', robotId: id });
  });
  onChange(state.link.signaling, (now) => {
    if (now !== 'connecting' && now !== 'stopped') add({ kind: 'signaling', state: now });
  });
  client.on('welcome', ({ robotId, name, access }) =>
    add({ kind: 'session-began', robotId, name, operator: access?.name ?? operator }),
  );
  client.on('loss', (reason) => add({ kind: 'session-lost', reason, detail: client.link.lossDetail ?? '' }));
  client.on('path', (up) => add({ kind: up ? 'path-restored' : 'path-lost' }));
  client.on('grantExpires', (inS) => add({ kind: 'grant-ends', inS }));
  client.on('refused', (detail) => add({ kind: 'request-refused', detail }));
}

/** Whether the robot is heard, and how much comes. */
function feedLink({ client, state, now }: EventSources, add: AddEvent): void {
  let silentSinceMs: number | null = null;
  const silence = computed(() => (state.link.live.value ? state.link.silence.value : null));
  onChange(silence, (is) => {
    if (is === 'lost') {
      silentSinceMs = now() - client.link.silentMs(now());
      add({ kind: 'robot-silent' });
      return;
    }
    if (is === 'heard' && silentSinceMs !== null)
      add({ kind: 'robot-heard', silentMs: Math.round(now() - silentSinceMs) });
    if (is !== 'unheard') silentSinceMs = null;
  });
  const losses = new LossEvents();
  effect(() => {
    if (!state.link.live.value) {
      losses.reset();
      return;
    }
    const found = losses.observe(state.figures.value.lossRate);
    if (found !== null) untracked(() => add(found));
  });
  let motion = new MotionEvents();
  client.on('session', () => {
    motion = new MotionEvents();
  });
  client.on('telemetry', (telemetry) => {
    for (const detail of motion.observe(telemetry)) add(detail);
  });
}

function feedDriving(client: EventSources['client'], add: AddEvent): void {
  let last = 'nobody';
  client.on('session', () => {
    last = 'nobody';
  });
  client.on('lease', ({ holder, driver = '' }) => {
    const now = `${holder} ${driver}`.trim();
    if (now !== last) add({ kind: 'lease', holder, driver });
    last = now;
  });
  client.on('handover', (handover) => {
    const detail = handoverDetail(handover);
    if (detail !== null) add(detail);
  });
  client.on('commandRejected', ({ reason, count }) => add({ kind: 'command-refused', reason }, count));
  client.on('otherDrives', () => add({ kind: 'other-drives' }));
  client.on('gripLost', (loss) => add({ kind: 'grip-lost', loss }));
}

/** `null` while it is open. */
function handoverDetail({ kind, from, to, ended }: Handover): EventDetail | null {
  if (ended === undefined) return null;
  return { kind: 'handover', step: kind, from: from.name, to: to.name, ended };
}

function feedStop({ client, state }: EventSources, add: AddEvent): void {
  client.on('stop', (status) => {
    if (status !== 'none') add({ kind: 'stop-delivery', status });
  });
  state.stopNews.onChange = (change) => add(stopDetail(change));
}

function stopDetail({ estop, cause, first, release }: StopChange): EventDetail {
  if (release !== null) return { kind: 'stop-released', by: release.by, name: release.name ?? '' };
  return {
    kind: 'stop',
    by: presser(cause) ?? estop.by ?? 'operator',
    name: cause?.pressedBy ?? '',
    heldBy: [...(cause?.heldBy ?? [])],
    start: cause?.pressedBy === undefined ? (cause?.start ?? null) : null,
    already: first,
  };
}

function presser(cause: EstopCause | null): 'you' | 'operator' | null {
  if (cause?.yours === true) return 'you';
  return cause?.pressedBy === undefined ? null : 'operator';
}

/** Alarms, latency tests, recordings and errors. */
function feedReports({ client, state }: EventSources, add: AddEvent): void {
  client.on('alarm', (alarm) => add(alarmDetail(alarm)));
  client.on('latency', ({ mtpMs, firstMs }) => add({ kind: 'latency', mtpMs, firstMs }));
  client.on('robotFault', (detail) => add({ kind: 'robot-fault', detail }));
  onChange(state.notices.failure, (failure) => {
    if (failure !== null) add({ kind: 'page-failed', detail: `${failure.title}. ${failure.text}` });
  });
  onChange(
    computed(() => state.robot.about.value?.recorded ?? false),
    (on) => {
      // Without a session nothing is known.
      if (on || state.link.live.peek()) add({ kind: 'recording', on });
    },
  );
}

function alarmDetail({ level, text, value, limit, unit, recorded }: Alarm): EventDetail {
  const said = { text, value, limit, unit, recorded: recorded === true };
  return level === 'ok' ? { kind: 'alarm-cleared', ...said } : { kind: 'alarm', level, ...said };
}

/** What the operator switches. */
function feedChoices({ state, settings }: EventSources, add: AddEvent): void {
  for (const [name, read] of Object.entries(settings) as [DetailOf<'setting'>['name'], () => boolean][])
    onChange(computed(read), (on) => add({ kind: 'setting', name, on }));
  onSwitch(state.cameras.all, (name, on) => add({ kind: 'camera', name, on }));
  onSwitch(state.videos.switches.all, (name, on) => add({ kind: 'camera', name, on }));
  onSwitch(state.sensors.all, (name, on) => add({ kind: 'sensor', name, on }));
}

/** Calls back when one is switched; a robot's list is no news. */
function onSwitch(all: ReadonlySignal<readonly Switch[]>, told: (name: string, on: boolean) => void): void {
  let before = new Map<Switch, boolean>();
  effect(() => {
    const now = new Map(all.value.map((each) => [each, each.on.value]));
    const changed = [...now].filter(([each, on]) => (before.get(each) ?? on) !== on);
    before = now;
    untracked(() => {
      for (const [{ name }, on] of changed) told(name, on);
    });
  });
}

/** Calls back when the value changes, not for what it is now. */
function onChange<T>(source: ReadonlySignal<T>, act: (now: T, before: T) => void): void {
  let before = source.peek();
  effect(() => {
    const now = source.value;
    if (now === before) return;
    const was = before;
    before = now;
    untracked(() => act(now, was));
  });
}
