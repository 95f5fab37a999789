import {
  ComponentReports,
  type Picture,
  Readings,
  type RobotClient,
  type RobotEvents,
  RobotPeople,
  type StopStatus,
} from '@farpoint/operator';
import type { EstopState, LeaseState, RobotListing, Telemetry, Welcome } from '@farpoint/protocol';
import { effect } from '@preact/signals-core';
import { describe, expect, test } from 'vitest';
import { PanelPlacements } from '../ground/panels/panel-placements.ts';
import type { SignalingFault } from '../ground/settings.ts';
import { RobotVoice } from '../testing/robot-voice.ts';
import type { PageStats } from '../words/page-stats.ts';
import { Notices } from './notices.ts';
import { PageState } from './page-state.ts';

type Phase = RobotEvents['phase'];

/** Stands in for the client: returns the values that a test puts in, and emits events on demand. */
class Client extends RobotVoice {
  chosenRobotId: string | null = null;
  pointsAtMs = 0;
  readonly session = {
    welcome: null as Welcome | null,
    lease: { type: 'lease', holder: 'nobody' } as LeaseState,
    grantEndsAtMs: null,
    telemetry: null as Telemetry | null,
    estop: { type: 'estop', latched: false } as EstopState,
    readings: new Readings(),
    alarms: new Map(),
    components: new ComponentReports(),
    people: new RobotPeople(),
  };
  readonly link = {
    phase: 'none' as Phase,
    signaling: 'ready' as const,
    robots: [] as readonly RobotListing[],
    ...{ robotListed: true, lastLoss: null, maxOperators: null, lossDetail: null, changedRobotKey: null },
    signInUrl: null,
    interrupted: false,
    ...{ session: this.session },
    silentMs: (nowMs: number) => nowMs - this.heardAtMs,
  };
  readonly stops = { status: 'none' as StopStatus };
  readonly driver = {
    holder: 'nobody' as LeaseState['holder'],
    stream: { held: false },
    input: null as { name: string } | null,
    lost: null,
    isGripped: false,
  };
  heardAtMs = 0;
  readonly watched: (readonly number[])[] = [];
  readonly watchedVideos: (readonly number[])[] = [];
  readonly shares: [cloud: number, videos: readonly number[]][] = [];
  readonly clouds: (readonly number[])[] = [];

  watch(cameras: readonly number[]): void {
    this.watched.push(cameras);
  }
  watchVideos(videos: readonly number[]): void {
    this.watchedVideos.push(videos);
  }

  shareLink(cloud: number, videos: readonly number[]): void {
    this.shares.push([cloud, videos]);
  }
  wantClouds(sensors: readonly number[]): void {
    this.clouds.push(sensors);
  }
  enter(phase: Phase): void {
    this.link.phase = phase;
    this.say('phase', phase);
  }
}

class Bench {
  readonly client = new Client();
  nowMs = 0;
  readonly state: PageState;

  constructor(signalingFault: SignalingFault | null = null) {
    this.state = new PageState({
      placements: new PanelPlacements(new Map(), () => undefined),
      client: this.client as unknown as RobotClient,
      settings: {
        signalingFault,
        signalingUrl: 'wss://signaling.example/operator',
        pointScale: 1,
        barcode: false,
      },
      notices: new Notices(),
      figures: () => ({ framesDrawn: this.nowMs }) as PageStats,
      now: () => this.nowMs,
      isOnline: () => true,
      newCanvas: () => ({ width: 0, height: 0, getContext: () => null }) as unknown as HTMLCanvasElement,
    });
  }

  /** Advances time and takes the next sample. */
  pass(ms: number): this {
    this.nowMs += ms;
    this.state.sample();
    return this;
  }
}

describe('the link', () => {
  test('its line is right at each event', () => {
    const { client, state } = new Bench();
    const lines: string[] = [];
    effect(() => {
      lines.push(state.link.line.value.text);
    });
    client.chosenRobotId = 'r1';
    client.enter('opening');
    expect([state.link.connected.value, state.link.live.value]).toEqual([true, false]);
    client.enter('live');
    expect(lines).toEqual(['Signaling connected', 'Connecting to the robot…', 'Live']);
    expect(state.link.live.value).toBe(true);
  });

  test('shows that the robot is silent without waiting for an event', () => {
    const bench = new Bench();
    bench.client.enter('live');
    expect(bench.state.link.line.value.text).toBe('Live');
    expect(bench.pass(2000).state.link.line.value.text).toContain('lost for 2 s');
  });

  test('follows a silence without waiting for the next sample, and samples no more often than it changes', () => {
    const bench = new Bench();
    const { client, state } = bench;
    client.chosenRobotId = 'r1';
    client.enter('live');
    const told: [heard: boolean, banner: string | null][] = [];
    let samples = 0;
    effect(() => {
      void state.sampledAtMs.value;
      samples++;
    });
    effect(() => void told.push([state.link.heard.value, state.link.banner.value?.title ?? null]));
    client.driver.holder = 'you';
    for (; bench.nowMs < 750; bench.nowMs += 25) {
      // The points stop as well.
      client.pointsAtMs = 0;
      state.followSilence(bench.nowMs);
      if (bench.nowMs === 425) expect(state.driving.line.value.text).toBe('The robot does not hear you');
    }
    expect(told).toEqual([
      [true, null],
      [false, null],
      [false, 'The robot does not answer'],
    ]);
    expect(samples).toBe(3);
    client.heardAtMs = bench.nowMs;
    client.pointsAtMs = bench.nowMs;
    state.followSilence(bench.nowMs);
    expect(told.at(-1)).toEqual([true, null]);
  });

  test('points that stop alone are told of as soon', () => {
    const bench = new Bench();
    const { client, state } = bench;
    client.enter('live');
    for (; bench.nowMs < 425; bench.nowMs += 25) {
      client.heardAtMs = bench.nowMs;
      state.followSilence(bench.nowMs);
    }
    expect([state.link.heard.value, state.robot.pointsHeard.value]).toEqual([true, false]);
  });

  test('reports an unusable signaling address while there is no session', () => {
    const { client, state } = new Bench({ reason: 'no-address', address: 'x:y' });
    expect(state.link.line.value).toEqual({
      text: 'Signaling address: “x:y” is not an address',
      tone: 'bad',
    });
    client.enter('live');
    expect(state.link.line.value.text).toBe('Live');
  });

  test('the next robot follows the chosen one', () => {
    const { client, state } = new Bench();
    client.chosenRobotId = 'a';
    client.link.robots = [
      { id: 'a', name: 'A' },
      { id: 'b', name: 'B' },
    ];
    client.say('robots', client.link.robots);
    expect(state.link.nextRobot.value?.id).toBe('b');
  });
});

test('shows the emergency stop only during a session', () => {
  const { client, state } = new Bench();
  client.session.estop = { type: 'estop', latched: true, by: 'robot' };
  client.say('estop', client.session.estop);
  expect(state.robot.estopLatched.value).toBe(false);
  client.enter('live');
  expect(state.robot.estopLatched.value).toBe(true);
});

test('shows what has become of STOP, also without a session', () => {
  const { client, state } = new Bench();
  expect(state.robot.stop.value).toBe('none');
  client.stops.status = 'unconfirmed';
  client.say('stop', 'unconfirmed');
  expect(state.robot.stop.value).toBe('unconfirmed');
  // Through a bridge, no robot has said so.
  client.stops.status = 'confirmed';
  client.say('stop', 'confirmed');
  expect(state.robot.stop.value).toBe('none');
  client.session.estop = { type: 'estop', latched: true, by: 'operator', latch: 1, press: 1 };
  client.say('estop', client.session.estop);
  expect(state.robot.stop.value).toBe('confirmed');
});

test('shows who drives, and with which device', () => {
  const bench = new Bench();
  const { client, state } = bench;
  expect(state.driving.line.value.text).toBe('Nobody is driving');
  client.driver.holder = 'you';
  client.say('lease', { type: 'lease', holder: 'you' });
  expect(state.driving.line.value.text).toBe('You have control');
  Object.assign(client.driver, { stream: { held: true }, input: { name: 'keyboard' } });
  expect(bench.pass(250).state.driving.line.value.text).toBe('You are driving (keyboard)');
});

test('figures change only with the next sample', () => {
  const bench = new Bench().pass(250);
  const drawn = () => bench.state.figures.value.framesDrawn;
  expect(drawn()).toBe(250);
  bench.nowMs += 100;
  expect(drawn()).toBe(250);
  expect(bench.pass(0) && drawn()).toBe(350);
});

describe('what the page requests from the robot', () => {
  test('requests nothing before the robot has listed anything', () => {
    const { client, state } = new Bench();
    client.say('session', 1);
    state.looking.value = false;
    expect([client.watched, client.clouds]).toEqual([[], []]);
  });

  test('requests pictures of shown cameras while somebody looks, again in each session', () => {
    const { client, state } = new Bench();
    const cameras = [{ name: 'front' }, { name: 'rear' }];
    client.say('cameras', cameras);
    state.cameras.toggle(0);
    state.looking.value = false;
    state.looking.value = true;
    client.say('session', 2);
    client.say('cameras', cameras);
    expect(client.watched).toEqual([[0, 1], [1], [], [1], [1]]);
  });

  test('requests the videos that are on, again in each session, but not when only a fault changes', () => {
    const { client, state } = new Bench();
    const videos: RobotEvents['videos'] = [
      { name: 'front', mid: '1', codec: 'H264' },
      { name: 'rear', mid: '2', codec: 'VP8' },
    ];
    client.say('videos', videos);
    client.say('videos', [videos[0]!, { ...videos[1]!, fault: 'unplugged' }]);
    const [, rear] = state.views.value;
    expect(rear?.fault.value).toBe('unplugged');
    rear?.toggle();
    state.looking.value = false;
    state.looking.value = true;
    client.say('session', 2);
    expect(state.views.value).toEqual([]);
    client.say('videos', videos);
    expect(state.views.value[1]?.fault.value).toBe(null);
    expect(client.watchedVideos).toEqual([[0, 1], [0], [], [0], [0]]);
  });

  test('tells the robot how to divide the link: by what comes first, and more for the enlarged video', () => {
    const { client, state } = new Bench();
    const videos: RobotEvents['videos'] = ['front', 'rear', 'left'].map((name, mid) => ({
      ...{ name, mid: String(mid), codec: 'H264' as const },
    }));
    client.say('videos', videos);
    state.priority.chosen.value = 'cameras';
    state.enlarged.toggle(state.views.value[1]!);
    state.priority.chosen.value = 'clouds';
    client.say('session', 2);
    client.say('videos', videos);
    expect(client.shares).toEqual([
      [2, [1, 1, 1]],
      [1, [2, 2, 2]],
      [1, [2, 6, 2]],
      [6, [1, 3, 1]],
      [6, [1, 1, 1]],
    ]);
  });

  test('requests clouds of sensors that are on', () => {
    const { client, state } = new Bench();
    client.say('sensors', [{ name: 'depth' }, { name: 'lidar' }]);
    state.sensors.toggle(1);
    state.sensors.toggle(0);
    expect(client.clouds).toEqual([[0, 1], [0], []]);
  });
});

describe('pictures', () => {
  const picture = (camera: number, takenAtMs: number) => {
    let closed = false;
    const bitmap = { width: 4, height: 3, close: () => (closed = true) } as unknown as ImageBitmap;
    return { picture: { camera, bitmap, takenAtMs } satisfies Picture, closed: () => closed };
  };

  test('their age counts from capture, and they are stale after a second', () => {
    const bench = new Bench();
    const { client, state } = bench;
    client.say('cameras', [{ name: 'front' }]);
    const [view] = state.pictures.views.value;
    expect([view?.ageMs.value, view?.stale.value]).toEqual([null, false]);
    bench.nowMs = 90;
    const first = picture(0, 10);
    client.say('picture', first.picture);
    expect(first.closed()).toBe(true);
    // Immediately, not only from the next sample on.
    expect([view?.ageMs.value, view?.newest.value?.number, view?.canvas.width]).toEqual([80, 1, 4]);
    bench.pass(1000);
    expect([view?.ageMs.value, view?.stale.value]).toEqual([1080, true]);
  });

  test('closes a picture of an unknown camera', () => {
    const { client } = new Bench();
    const lost = picture(3, 0);
    client.say('picture', lost.picture);
    expect(lost.closed()).toBe(true);
  });

  test('forgets them when another session begins', () => {
    const { client, state } = new Bench();
    client.say('cameras', [{ name: 'front' }]);
    client.say('picture', picture(0, 0).picture);
    client.say('session', 2);
    client.say('cameras', [{ name: 'front' }]);
    expect(state.pictures.views.value[0]?.newest.value).toBe(null);
  });
});

test('a camera that is chosen again and again is enlarged, fills the screen, and is as before', () => {
  const { client, state } = new Bench();
  client.say('cameras', [{ name: 'front' }, { name: 'rear' }]);
  client.enter('live');
  const [front, rear] = state.views.value;
  if (front === undefined || rear === undefined) throw new Error('no views');
  const shown = () => [state.enlarged.view.value, state.staged.view.value];
  state.nextSize(front);
  expect(shown()).toEqual([front, null]);
  state.nextSize(front);
  expect(shown()).toEqual([null, front]);
  // Another one takes its place.
  state.nextSize(rear);
  expect(shown()).toEqual([rear, null]);
  // The key takes the one that is enlarged.
  state.swap();
  expect(shown()).toEqual([null, rear]);
  state.swap();
  state.enlarged.toggle(rear);
  state.nextSize(rear);
  state.nextSize(rear);
  expect(shown()).toEqual([null, null]);
});
