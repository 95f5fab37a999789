/**
 * What the event log can say: the kinds of events, their typed parameters, and how severe each is. An event holds no sentence:
 * words/event-words.ts says it in a language. Pure.
 */
import type { GripLoss, SessionLoss } from '@farpoint/operator';
import {
  type CommandRejection,
  type EstopStart,
  handoverEnds,
  interventions,
  obstacleGuardStates,
  readingLevels,
  robotStops,
} from '@farpoint/protocol';
import * as z from 'zod/mini';

/** Longer texts of an event are cut: the longest of the robot's, its alarms', have 120 characters. */
export const MOST_TEXT = 200;
/** Elements of a list of an event; there are fewer reasons and stops. */
const MOST_LISTED = 16;

const losses: Record<SessionLoss, true> = {
  'not-connected': true,
  'connection-failed': true,
  'robot-full': true,
  'robot-restarted': true,
  'robot-stopped': true,
  'robot-left': true,
  'bad-answer': true,
  'not-granted': true,
  'robot-key-changed': true,
  'robot-unproven': true,
  'grant-expired': true,
  'grant-revoked': true,
  'ended-by-supervisor': true,
  'unproven-peer': true,
  'not-reading': true,
  unheard: true,
  'closed-by-robot': true,
  silent: true,
  'signaling-lost': true,
  refused: true,
};
const rejections: Record<CommandRejection, true> = {
  malformed: true,
  'out-of-range': true,
  stale: true,
  repeated: true,
  'not-permitted': true,
  'not-lease-holder': true,
  'dead-man-released': true,
  'let-go-first': true,
  'no-wheels': true,
  'estop-latched': true,
  'rate-limited': true,
};
const starts: Record<EstopStart, true> = {
  'was-latched': true,
  'unclean-exit': true,
  unreadable: true,
  unwritable: true,
};
const gripLosses: Record<GripLoss, true> = {
  'late-reading': true,
  'hands-away': true,
  'path-lost': true,
  'other-drives': true,
  'let-go': true,
};

/** A complete list of a type's values. */
function valuesOf<Value extends string>(of: Readonly<Record<Value, true>>): [Value, ...Value[]] {
  return Object.keys(of) as [Value, ...Value[]];
}

const text = z.string().check(z.maxLength(MOST_TEXT));
const number = z.number();
const reasons = z.array(z.enum(interventions)).check(z.maxLength(MOST_LISTED));
const alarm = {
  text,
  value: number,
  limit: number,
  unit: text,
  recorded: z.boolean(),
};

const kind = <Kind extends string>(name: Kind) => z.literal(name);

const detailSchema = z.discriminatedUnion('kind', [
  z.object({ kind: kind('page-opened') }),
  z.object({
    kind: kind('signaling'),
    state: z.enum(['connecting', 'ready', 'waiting', 'refused', 'stopped']),
  }),
  z.object({ kind: kind('robot-chosen'), robotId: text }),
  z.object({ kind: kind('robot-left'), robotId: text }),
  z.object({ kind: kind('session-began'), robotId: text, name: text, operator: text }),
  z.object({ kind: kind('session-lost'), reason: z.enum(valuesOf(losses)), detail: text }),
  z.object({ kind: kind('path-lost') }),
  z.object({ kind: kind('path-restored') }),
  z.object({ kind: kind('robot-silent') }),
  z.object({ kind: kind('robot-heard'), silentMs: number }),
  z.object({ kind: kind('grant-ends'), inS: number }),
  z.object({ kind: kind('request-refused'), detail: text }),
  z.object({ kind: kind('rate-fell'), fromKbps: number, toKbps: number }),
  z.object({ kind: kind('rate-recovered'), toKbps: number }),
  z.object({ kind: kind('loss-high'), percent: number }),
  z.object({ kind: kind('loss-over'), percent: number }),
  z.object({ kind: kind('lease'), holder: z.enum(['you', 'other', 'nobody']), driver: text }),
  z.object({
    kind: kind('handover'),
    step: z.enum(['ask', 'offer']),
    from: text,
    to: text,
    ended: z.enum(handoverEnds),
  }),
  z.object({ kind: kind('command-refused'), reason: z.enum(valuesOf(rejections)) }),
  z.object({ kind: kind('other-drives') }),
  z.object({ kind: kind('grip-lost'), loss: z.enum(valuesOf(gripLosses)) }),
  z.object({
    kind: kind('stop'),
    by: z.enum(['you', 'operator', 'robot']),
    name: text,
    heldBy: z.array(z.enum(robotStops)).check(z.maxLength(MOST_LISTED)),
    start: z.nullable(z.enum(valuesOf(starts))),
    already: z.boolean(),
  }),
  z.object({ kind: kind('stop-released'), by: z.enum(['you', 'operator', 'robot']), name: text }),
  z.object({
    kind: kind('stop-delivery'),
    status: z.enum(['unconfirmed', 'confirmed', 'undelivered']),
  }),
  z.object({ kind: kind('held'), reasons }),
  z.object({ kind: kind('slowed'), reasons }),
  z.object({ kind: kind('free') }),
  z.object({ kind: kind('blocked') }),
  z.object({ kind: kind('watchdog') }),
  z.object({ kind: kind('let-go-first') }),
  z.object({ kind: kind('guard-state'), state: z.enum(obstacleGuardStates) }),
  z.object({ kind: kind('alarm'), level: z.enum(readingLevels), ...alarm }),
  z.object({ kind: kind('alarm-cleared'), ...alarm }),
  z.object({ kind: kind('camera'), name: text, on: z.boolean() }),
  z.object({ kind: kind('sensor'), name: text, on: z.boolean() }),
  z.object({
    kind: kind('setting'),
    name: z.enum(['predict', 'synchronised', 'cues', 'clips', 'surface', 'hazards', 'remembers']),
    on: z.boolean(),
  }),
  z.object({ kind: kind('recording'), on: z.boolean() }),
  z.object({ kind: kind('latency'), mtpMs: number, firstMs: number }),
  z.object({ kind: kind('robot-fault'), detail: text }),
  z.object({ kind: kind('page-failed'), detail: text }),
  z.object({ kind: kind('picture-saved') }),
  z.object({ kind: kind('clip-saved'), seconds: number }),
  z.object({ kind: kind('suppressed'), count: number }),
]);

/** What happened, with its parameters. Texts of the robot and of people are as they said them. */
export type EventDetail = z.infer<typeof detailSchema>;
export type EventKind = EventDetail['kind'];
export type DetailOf<Kind extends EventKind> = Extract<EventDetail, { kind: Kind }>;

export type Severity = 'info' | 'warning' | 'error';

/** The parts that the log can be filtered by. */
export const EVENT_GROUPS = ['connection', 'link', 'driving', 'stop', 'limits', 'alarms', 'page'] as const;
export type EventGroup = (typeof EVENT_GROUPS)[number];

/** The last ms since the epoch that a date can have. */
const LAST_MS = 8.64e15;
const time = z.number().check(z.minimum(0), z.maximum(LAST_MS));

/** One entry of the log as it is kept. */
export const eventSchema = z.object({
  /** When it happened first, and when it happened last: ms since the epoch. */
  atMs: time,
  lastMs: time,
  /** How often it happened in between. */
  times: z.int().check(z.minimum(1)),
  /** How long the session had lasted when it happened first, ms; `null` without a session. */
  sessionMs: z.nullable(z.number().check(z.minimum(0))),
  /** The robot's name, or its id while it has not said its name; `null` if it concerns none. */
  robot: z.nullable(text),
  detail: detailSchema,
});

export type PageEvent = z.infer<typeof eventSchema>;

/** With its texts cut to {@link MOST_TEXT} and its lists to what is kept: what a robot says is as long as it likes. */
export function bounded(detail: EventDetail): EventDetail {
  const cut = (value: unknown): unknown => {
    if (typeof value === 'string') return value.slice(0, MOST_TEXT);
    return Array.isArray(value) ? value.slice(0, MOST_LISTED) : value;
  };
  return Object.fromEntries(Object.entries(detail).map(([name, value]) => [name, cut(value)])) as EventDetail;
}
