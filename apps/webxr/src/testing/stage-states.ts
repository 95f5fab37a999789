/**
 * The states in which the page can be looked at without a robot: `pnpm page` lists them, and tests begin from them. Each is a
 * function that scripts the robot.
 */
import type { StageControl } from './stage-control.ts';
import {
  commands,
  fleet,
  freeMotion,
  lidarRings,
  lowBattery,
  people,
  sound,
  telemetryOf,
  thingAt,
  threePeople,
  twoCameras,
  twoSensors,
  twoVideos,
} from './stage-messages.ts';

export interface StageState {
  /** For people. */
  what: string;
  /** Clouds to be loaded before it begins. */
  clouds?: readonly string[];
  begin(stage: StageControl): void;
}

/** When the session is there, whatever comes first in it has come, ms. */
const SETTLED_MS = 400;

/** The robot is there, and the page connects to it. @param cloud that it sends; `null`: none */
function connect(stage: StageControl, cloud: string | null = 'light'): void {
  const { robot, link, app } = stage;
  robot.appear(link);
  app.choose(robot.id);
  if (cloud !== null) stage.stream(cloud);
}

/** A state that comes about once the page is connected. */
function afterwards(what: string, act: (stage: StageControl) => void): StageState {
  return {
    what,
    clouds: ['light'],
    begin(stage) {
      connect(stage);
      setTimeout(() => act(stage), SETTLED_MS);
    },
  };
}

/** A state of a robot that says this when the page connects. */
function robotThat(what: string, prepare: (stage: StageControl) => void): StageState {
  return {
    what,
    clouds: ['light'],
    begin(stage) {
      prepare(stage);
      connect(stage);
    },
  };
}

/** A state in which the page has no session. */
function without(what: string, begin: (stage: StageControl) => void): StageState {
  return { what, begin };
}

const [BLUE, SKY] = [[70, 110, 160] as const, [90, 140, 190] as const];
const [BROWN, SAND] = [[150, 110, 70] as const, [180, 140, 90] as const];

/** Once the session is there. */
function playTwo(stage: StageControl): void {
  setTimeout(() => {
    stage.play({
      Front: { quarters: [BLUE, SKY, SKY, BLUE], delayMs: 40 },
      Rear: { quarters: [BROWN, SAND, SAND, BROWN], delayMs: 60 },
    });
  }, SETTLED_MS);
}

const states = {
  blank: without('Nothing has happened yet', () => undefined),
  'no-robots': without('The service lists no robot', ({ link }) => link.enterSignaling('ready')),
  disconnected: without('Two robots to choose from', ({ link, robot }) => {
    robot.appear(link);
    link.list([
      { id: robot.id, name: robot.name },
      { id: 'stage-2', name: 'Another robot' },
    ]);
  }),
  fleet: without('Twelve robots that tell what they do, one with the longest of names', ({ link }) => {
    link.enterSignaling('ready');
    link.list(fleet.map(({ id, name }) => ({ id, name })));
    link.statusFeed = {
      statuses: new Map(fleet.map(({ id, status }) => [id, status])),
      watchStatuses: () => undefined,
    };
  }),
  'service-away': without('The signaling service cannot be reached', ({ link }) =>
    link.enterSignaling('waiting'),
  ),
  'token-refused': without('The signaling service refused the token', ({ link }) =>
    link.enterSignaling('refused'),
  ),
  connecting: without('The robot does not answer yet', (stage) => {
    stage.robot.admits = false;
    connect(stage, null);
  }),
  'robot-full': without('The robot accepts no more operators', (stage) => {
    stage.robot.onRequest = () => stage.link.end('robot-full', null, 4);
    connect(stage, null);
  }),
  'not-granted': without('The robot asks for a grant', (stage) => {
    stage.robot.onRequest = () => stage.link.end('not-granted', 'no grant for this robot');
    connect(stage, null);
  }),
  'key-changed': without('The robot proves another key', (stage) => {
    const changed = { robotId: stage.robot.id, known: 'aaaa-bbbb', shown: 'cccc-dddd' };
    stage.robot.onRequest = () => stage.link.fail('robot-key-changed', changed as never);
    connect(stage, null);
  }),
  live: robotThat('Connected, nobody drives', () => undefined),
  still: {
    what: 'Connected to a robot that sends no clouds: a test or the console sends them',
    clouds: ['light', 'grey-room', 'depth-room', 'lidar-yard'],
    begin: (stage) => connect(stage, null),
  },
  driving: afterwards('You have control', ({ robot }) => robot.giveLease('you')),
  'other-drives': afterwards('Somebody else drives', ({ robot }) => robot.giveLease('other', 'Bo')),
  'stop-latched': afterwards('The emergency stop is latched', ({ app }) => void app.client.estop()),
  'stopped-at-robot': afterwards('A stop at the robot itself is on', ({ robot }) =>
    robot.stop({ latched: true, by: 'robot', releasedAt: 'robot', latch: 1 }),
  ),
  'stop-unconfirmed': afterwards('STOP was pressed while the network is away', (stage) => {
    stage.cut();
    setTimeout(() => stage.app.client.estop(), 1500);
  }),
  'stop-by-other': afterwards('Another operator has pressed STOP, and drives', ({ robot }) => {
    robot.giveLease('other', 'Bo');
    robot.stop({ latched: true, by: 'operator', latch: 1 }, { pressedBy: 'Bo' });
  }),
  'path-lost': afterwards('Nothing arrives any more', (stage) => stage.cut()),
  'robot-lost': afterwards(
    'The robot was killed while you drove: the service does not see it, either',
    (stage) => {
      stage.robot.giveLease('you');
      setTimeout(() => {
        stage.cut();
        stage.link.list([]);
      }, SETTLED_MS);
    },
  ),
  'link-lost': afterwards('This computer’s network is gone', (stage) => {
    stage.cut();
    stage.link.enterSignaling('waiting');
  }),
  'decoder-hung': afterwards('The robot is heard, but its points do not come', (stage) => stage.stream(null)),
  'taken-over': afterwards('Another operator has taken over while you held the grip', (stage) => {
    const { robot } = stage;
    robot.giveLease('you');
    window.dispatchEvent(new KeyboardEvent('keydown', { code: 'Space' }));
    setTimeout(() => robot.giveLease('other', 'Bo'), SETTLED_MS);
  }),
  'unknown-robot': without('A robot that the service does not list', ({ link, app }) => {
    link.enterSignaling('ready');
    link.list([]);
    app.choose('rover-that-nobody-knows');
  }),
  'robot-gone': afterwards('The robot was shut down', ({ link }) => {
    link.list([]);
    link.end('shutting-down');
  }),
  'session-over': afterwards(
    'You have disconnected: the list of robots has the session’s report',
    ({ app }) => setTimeout(() => app.client.leave(), SETTLED_MS),
  ),
  'view-too-old': afterwards('Held: what you see is too old', ({ robot }) => {
    robot.giveLease('you');
    const motion = { ...freeMotion, factor: 0, reasons: ['view-lost'] as const, viewAgeMs: 900 };
    robot.telemetry = { drive: 'blocked', motion };
  }),
  'view-late': afterwards('Slower: what you see is old', ({ robot }) => {
    robot.giveLease('you');
    const reasons = ['blind-travel', 'view-late'] as const;
    robot.telemetry = { motion: { ...freeMotion, factor: 0.4, reasons, mostLinear: 0.2, viewAgeMs: 350 } };
  }),
  'obstacle-ahead': afterwards('Held: something is in the way', (stage) => {
    const { robot } = stage;
    robot.giveLease('you');
    robot.telemetry = { drive: 'blocked', motion: { ...freeMotion, factor: 0, reasons: ['obstacle'] } };
    setInterval(() => stage.tell(thingAt(0, 0.1, robot.nowMs)), 100);
  }),
  'guard-blind': robotThat('The robot cannot see obstacles', ({ robot }) => {
    robot.telemetry = { motion: { ...freeMotion, obstacleGuard: 'blind' } };
  }),
  'guard-off': robotThat('The robot does not look where it goes', ({ robot }) => {
    robot.telemetry = { motion: { ...freeMotion, obstacleGuard: 'off' } };
  }),
  returning: robotThat('The robot drives back along its track', ({ robot }) => {
    robot.telemetry = { motion: { ...freeMotion, return: { phase: 'returning', metres: 1.2 } } };
  }),
  'came-back': robotThat('The robot came back while its link was away', ({ robot }) => {
    robot.telemetry = {
      motion: { ...freeMotion, return: { phase: 'ended', metres: 2.3, end: 'service-back' } },
    };
  }),
  watching: robotThat('Your grant lets you watch', ({ robot }) => {
    robot.access = { role: 'watch', name: 'Anna', expiresInS: 3600 };
  }),
  people: robotThat('Several people are here', ({ robot }) => {
    robot.access = { role: 'supervise', name: 'Anna', expiresInS: 3600 };
    robot.greeting = [people];
  }),
  'asked-to-drive': afterwards('You drive, and another asks you for the drive', ({ robot }) => {
    robot.people.here = threePeople;
    robot.giveLease('you');
    robot.people.wants('ask', 'Bo');
  }),
  'offered-the-drive': afterwards('The driver offers you the drive', ({ robot }) => {
    robot.people.here = threePeople;
    robot.giveLease('other', 'Bo');
    robot.people.wants('offer', 'Bo');
  }),
  'own-request': afterwards('You have asked the driver for the drive', ({ robot, app }) => {
    robot.people.here = threePeople;
    robot.giveLease('other', 'Bo');
    app.client.people.askToDrive();
  }),
  alarm: robotThat('The battery is low', ({ robot }) => {
    robot.greeting = [...telemetryOf(robot.nowMs), lowBattery(robot.nowMs)];
  }),
  playback: robotThat('The robot plays a recording', ({ robot }) => {
    const told = telemetryOf(robot.nowMs).map((message) =>
      message.type === 'quantity' || message.type === 'diagnostics'
        ? { ...message, recorded: true as const }
        : message,
    );
    const about = { type: 'about', drives: false, shows: 'files', recorded: false } as const;
    robot.greeting = [about, ...told, lowBattery(robot.nowMs, true)];
  }),
  recorded: robotThat('The robot records the session', ({ robot }) => {
    robot.greeting = [{ type: 'about', drives: true, shows: 'sensors', recorded: true }];
  }),
  commands: robotThat('The robot has commands, one of which runs, and records', ({ robot }) => {
    robot.greeting = [...commands];
  }),
  'two-sensors': {
    what: 'A camera and a LiDAR',
    clouds: ['light', 'lidar-yard'],
    begin(stage) {
      stage.robot.greeting = [twoSensors, lidarRings];
      connect(stage, null);
      setInterval(() => {
        if (stage.link.phase !== 'live') return;
        const wanted = stage.sent('sensors').at(-1)?.sensors ?? [0];
        for (const sensor of wanted) stage.cloud(sensor === 0 ? 'light' : 'lidar-yard', { sensor });
      }, 200);
    },
  },
  videos: robotThat('Two videos', (stage) => {
    stage.robot.greeting = [twoVideos];
    playTwo(stage);
  }),
  cameras: robotThat('Two cameras that have sent no picture', ({ robot }) => {
    robot.greeting = [twoCameras];
  }),
  everything: {
    what: 'A robot with all that the page can show, stopped, held and with an alarm',
    clouds: ['light', 'lidar-yard'],
    begin(stage) {
      const { robot } = stage;
      robot.access = { role: 'supervise', name: 'Anna', expiresInS: 3600 };
      const seen = [twoSensors, lidarRings, twoVideos, twoCameras, sound, people, ...commands];
      robot.greeting = [...seen, ...telemetryOf(robot.nowMs), lowBattery(robot.nowMs)];
      const motion = { ...freeMotion, factor: 0, reasons: ['obstacle'] as const };
      robot.telemetry = { drive: 'blocked', motion };
      robot.lease = { type: 'lease', holder: 'other', driver: 'Bo' };
      connect(stage);
      setInterval(() => stage.tell(thingAt(0, 0.1, robot.nowMs)), 100);
      setTimeout(() => stage.app.client.estop(), SETTLED_MS);
    },
  },
} satisfies Record<string, StageState>;

export type StageStateName = keyof typeof states;
export const STAGE_STATES: Readonly<Record<StageStateName, StageState>> = states;

export function isStageState(name: string): name is StageStateName {
  return Object.hasOwn(states, name);
}
