/** What the event log says, and its panel. */
import type { GripLoss, SessionLoss } from '@farpoint/operator';
import type {
  CommandRejection,
  EstopStart,
  HandoverEnd,
  Intervention,
  ObstacleGuardState,
  RobotStop,
} from '@farpoint/protocol';
import type { DetailOf, EventGroup, EventKind, Severity } from '../../ground/events/page-event.ts';

const losses = {
  'not-connected': 'no connection could be established in time',
  'connection-failed': 'the connection failed',
  'robot-full': 'the robot accepts no more operators',
  'robot-restarted': 'the robot restarted',
  'robot-stopped': 'the robot was shut down',
  'robot-left': 'the robot went offline while connecting',
  'bad-answer': 'the robot cannot use this browser’s answer',
  'not-granted': 'no valid grant for this robot',
  'robot-key-changed': 'the robot’s key has changed',
  'robot-unproven': 'the robot did not prove its identity',
  'grant-expired': 'the grant expired',
  'grant-revoked': 'the grant was revoked',
  'ended-by-supervisor': 'ended by a supervisor',
  'unproven-peer': 'the connection is not encrypted end to end',
  'not-reading': 'this page could not keep up with the robot’s messages',
  unheard: 'the robot had not heard from this page for too long',
  'closed-by-robot': 'closed by the robot',
  silent: 'the robot did not respond',
  'signaling-lost': 'signaling was lost while connecting',
  refused: 'the signaling service refused the session',
} satisfies Record<SessionLoss, string>;

const rejections = {
  malformed: 'unreadable',
  'out-of-range': 'speed above the limits',
  stale: 'too old on arrival',
  repeated: 'out of order',
  'not-permitted': 'the grant does not permit driving',
  'not-lease-holder': 'someone else drives',
  'dead-man-released': 'the grip is not held',
  'let-go-first': 'the grip must be released first',
  'no-wheels': 'the drive accepts no commands',
  'estop-latched': 'the emergency stop is on',
  'rate-limited': 'too many commands',
} satisfies Record<CommandRejection, string>;

const reasons = {
  'view-unknown': 'the age of the operator’s view is unknown',
  'view-late': 'the operator’s view is late',
  'view-lost': 'the operator’s view is too old',
  'blind-travel': 'stopping distance at this delay',
  'obstacle-near': 'an obstacle is near',
  obstacle: 'an obstacle is in the way',
  'drop-off': 'the floor ahead is missing',
  'unseen-space': 'no sensor sees the space ahead',
  'sensor-silent': 'a sensor is silent',
  'collision-topic': 'collision monitor',
  'collision-silent': 'the collision monitor is silent',
  'fence-near': 'near the geofence',
  fence: 'edge of the geofence',
} satisfies Record<Intervention, string>;

const gripLosses = {
  'late-reading': 'it was not read for too long',
  'hands-away': 'the page or the headset was left',
  'path-lost': 'the connection was lost',
  'other-drives': 'someone else drove',
  'let-go': 'the drive was given up',
} satisfies Record<GripLoss, string>;

const handoverEnds = {
  accepted: 'accepted',
  refused: 'refused',
  withdrawn: 'withdrawn',
  expired: 'expired',
  'driver-changed': 'void: the driver changed',
  left: 'void: one of the two left',
  estop: 'void: STOP was pressed',
} satisfies Record<HandoverEnd, string>;

const starts = {
  'was-latched': 'it was on at the last shutdown',
  'unclean-exit': 'the last run did not shut down in order',
  unreadable: 'the stored state cannot be read',
  unwritable: 'its state cannot be stored',
} satisfies Record<EstopStart, string>;

const stops = {
  topic: 'a program on the robot',
  shm: 'a program on the robot',
  gpio: 'a stop button on the robot',
  key: 'a key at the robot’s keyboard',
} satisfies Record<RobotStop, string>;

const guards = {
  on: 'The obstacle guard is on.',
  blind: 'The obstacle guard is blind: no sensor reports.',
  off: 'The obstacle guard is off.',
} satisfies Record<ObstacleGuardState, string>;

const signaling = {
  connecting: 'Connecting to the signaling service.',
  ready: 'Connected to the signaling service.',
  waiting: 'The signaling service cannot be reached.',
  refused: 'The signaling service refused the token.',
  stopped: 'Disconnected from the signaling service.',
};

const settings = {
  predict: 'Predicted view',
  synchronised: 'Cameras and points in step',
  cues: 'Sound and vibration',
  clips: 'Keeping the last 30 s for a clip',
  surface: 'Surface',
  hazards: 'Hazard colours',
  remembers: 'Remembered world',
} satisfies Record<DetailOf<'setting'>['name'], string>;

const colon = (text: string) => (text === '' ? '' : `: ${text}`);
const onOff = (on: boolean) => (on ? 'on' : 'off');
const because = (all: readonly Intervention[]) => colon(all.map((reason) => reasons[reason]).join(', '));

function lostWords({ reason, detail }: DetailOf<'session-lost'>): string {
  return `Session ended: ${losses[reason]}${detail === '' ? '' : ` (${detail})`}.`;
}

function stopWords({ by, name, heldBy, start, already }: DetailOf<'stop'>): string {
  const since = already ? ' (when the session began)' : '';
  if (heldBy.length > 0) return `Emergency stop by ${heldBy.map((stop) => stops[stop]).join(', ')}${since}.`;
  if (start !== null) return `Emergency stop since the robot’s start: ${starts[start]}.`;
  const who = { you: 'you', operator: name === '' ? 'another operator' : name, robot: 'the robot itself' }[
    by
  ];
  return `Emergency stop by ${who}${since}.`;
}

function alarmWords({ text, value, limit, unit, recorded }: Omit<DetailOf<'alarm-cleared'>, 'kind'>): string {
  const figures = `${value} ${unit}, limit ${limit} ${unit}`.replaceAll(' ,', ',').trim();
  return `${recorded ? 'Recorded: ' : ''}${text} (${figures})`;
}

export const events = {
  /** The sentence of each kind of event. */
  kinds: {
    'page-opened': () => 'The page was opened.',
    signaling: ({ state }) => signaling[state],
    'robot-chosen': ({ robotId }) => `Robot chosen: ${robotId}.`,
    'robot-left': ({ robotId }) => `Disconnected from ${robotId}.`,
    'session-began': ({ name, operator }) => `Session with ${name} began; operator: ${operator}.`,
    'session-lost': lostWords,
    'path-lost': () => 'The network path to the robot was lost.',
    'path-restored': () => 'The network path to the robot was restored.',
    'robot-silent': () => 'Nothing is heard from the robot.',
    'robot-heard': ({ silentMs }) => `The robot is heard again after ${(silentMs / 1000).toFixed(1)} s.`,
    'grant-ends': ({ inS }) => `Your grant ends in ${inS} s.`,
    'request-refused': ({ detail }) => `The signaling service refused a request: ${detail}`,
    'rate-fell': ({ fromKbps, toKbps }) => `The link’s bit rate fell from ${fromKbps} to ${toKbps} kbit/s.`,
    'rate-recovered': ({ toKbps }) => `The link’s bit rate is back at ${toKbps} kbit/s.`,
    'loss-high': ({ percent }) => `Packet loss: ${percent} %.`,
    'loss-over': ({ percent }) => `Packet loss is down to ${percent} %.`,
    lease: ({ holder, driver }) =>
      ({
        you: 'You have the drive.',
        other: `${driver || 'Another operator'} drives.`,
        nobody: 'Nobody drives.',
      })[holder],
    handover: ({ step, from, to, ended }) =>
      `${step === 'ask' ? `${from} asked ${to} for the drive` : `${from} offered the drive to ${to}`}: ${handoverEnds[ended]}.`,
    'command-refused': ({ reason }) => `Command refused: ${rejections[reason]}.`,
    'other-drives': () => 'The grip was held while someone else drives.',
    'grip-lost': ({ loss }) => `The grip no longer counts: ${gripLosses[loss]}.`,
    stop: stopWords,
    'stop-released': ({ by, name }) =>
      by === 'robot'
        ? 'The emergency stop was released at the robot.'
        : `The emergency stop was released by ${by === 'you' ? 'you' : name || 'another operator'}.`,
    'stop-delivery': ({ status }) =>
      ({
        unconfirmed: 'STOP was pressed here and is not confirmed yet.',
        confirmed: 'The robot confirmed STOP.',
        undelivered: 'STOP never reached the robot.',
      })[status],
    held: ({ reasons: why }) => `The robot holds itself${because(why)}.`,
    slowed: ({ reasons: why }) => `The robot limits its speed${because(why)}.`,
    free: () => 'The robot no longer limits its speed.',
    blocked: () => 'The robot is blocked.',
    watchdog: () => 'The robot stopped: no recent command.',
    'let-go-first': () => 'The robot waits for the grip to be released.',
    'guard-state': ({ state }) => guards[state],
    alarm: (alarm) => `Alarm: ${alarmWords(alarm)}`,
    'alarm-cleared': (alarm) => `Alarm cleared: ${alarmWords(alarm)}`,
    camera: ({ name, on }) => `Camera ${name}: ${onOff(on)}.`,
    sensor: ({ name, on }) => `Sensor ${name}: ${onOff(on)}.`,
    setting: ({ name, on }) => `${settings[name]}: ${onOff(on)}.`,
    recording: ({ on }) =>
      on ? 'The robot records this session.' : 'The robot no longer records this session.',
    latency: ({ mtpMs, firstMs }) =>
      `Motion to photon: ${mtpMs.toFixed(0)} ms (first points ${firstMs.toFixed(0)} ms).`,
    'robot-fault': ({ detail }) => `The robot reports: ${detail}`,
    'page-failed': ({ detail }) => `Error on this page: ${detail}`,
    'picture-saved': () => 'A picture of the view was saved.',
    'clip-saved': ({ seconds }) => `A clip of ${seconds.toFixed(0)} s was saved.`,
    suppressed: ({ count }) => `${count} further events came too fast to be listed.`,
  } as { readonly [Kind in EventKind]: (detail: DetailOf<Kind>) => string },
  /** Why sessions end, and why commands are refused, by the kinds of the events. */
  losses: losses as Readonly<Record<string, string>>,
  rejections: rejections as Readonly<Record<string, string>>,
  severities: { info: 'note', warning: 'warning', error: 'error' } satisfies Record<Severity, string>,
  groups: {
    connection: 'connection',
    link: 'link quality',
    driving: 'driving',
    stop: 'emergency stop',
    limits: 'limits of motion',
    alarms: 'alarms',
    page: 'page',
  } satisfies Record<EventGroup, string>,
  /** In a file: the list keeps no more. */
  dropped: (count: number) => `${count} older events were dropped.`,
  all: 'all events',
  title: 'Events',
  close: 'Close',
  clear: 'Clear',
  clearTitle: 'Remove all events from this list',
  csv: 'CSV',
  csvTitle: 'Save all events as a table (CSV)',
  jsonLines: 'JSON Lines',
  jsonLinesTitle: 'Save all events, one JSON object per line',
  filterGroup: 'Show',
  filterText: 'Filter by text',
  time: 'Time',
  robot: 'Robot',
  severity: 'Severity',
  what: 'Event',
  empty: 'No events.',
  /** @param shown of `kept` events are listed; `dropped` older ones are gone */
  count: (shown: number, kept: number, dropped: number) =>
    `${shown} of ${kept} events${dropped === 0 ? '' : `; ${dropped} older ones were dropped`}`,
  newer: (count: number) => `${count} newer: show`,
  /** @param last time of day */
  again: (times: number, last: string) => `${times} ×, last at ${last}`,
};
