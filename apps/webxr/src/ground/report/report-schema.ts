/** What a session's report has. Its JSON file is this object; docs/events.md describes each field. Pure. */
import { commandStages, frameStages } from '@farpoint/operator';
import * as z from 'zod/mini';
import { MOST_TEXT } from '../events/page-event.ts';

export const REPORT_FORMAT = 'farpoint-session-report';
/** Goes up when a field changes its meaning or goes. */
export const REPORT_VERSION = 1;

const text = z.string().check(z.maxLength(MOST_TEXT));
const number = z.number();
const count = z.int().check(z.minimum(0));
/** The last ms since the epoch that a date can have. */
const LAST_MS = 8.64e15;
const time = z.number().check(z.minimum(0), z.maximum(LAST_MS));

const summary = z.nullable(z.object({ count, mean: number, p50: number, p95: number, max: number }));

const stages = <Stage extends string>(names: readonly Stage[]) =>
  z.object(Object.fromEntries(names.map((name) => [name, summary])) as Record<Stage, typeof summary>);

const driving = z.object({
  /** For how long this operator had the drive. */
  leaseS: number,
  drivingS: number,
  standingS: number,
  unknownS: number,
  distanceM: number,
  positionJumps: count,
  topSpeedMps: number,
});

const interventions = z.object({
  stopsByYou: count,
  stopsByOthers: count,
  stopsByRobot: count,
  /** Of those by others: how many by whom, as far as the robot names them. */
  stopsByName: z.record(text, count),
  held: count,
  heldS: number,
  slowed: count,
  slowedS: number,
  blocked: count,
  watchdog: count,
  letGoFirst: count,
  gripLost: count,
  handovers: count,
  takeovers: count,
  alarms: count,
  /** By reason. */
  commandsRefused: z.record(text, count),
});

const link = z.object({
  bytesReceived: count,
  packetsReceived: count,
  packetsLost: count,
  kbitPerSecond: summary,
  roundTripMs: summary,
  outages: count,
  outageS: number,
  longestOutageS: number,
  rateFalls: count,
});

const view = z.object({
  framesPerSecond: summary,
  pointsPerSecond: summary,
  displayFramesPerSecond: summary,
  ageMs: summary,
});

const latency = z.object({
  frameMs: summary,
  frameStagesMs: stages(frameStages),
  commandMs: summary,
  commandStagesMs: stages(commandStages),
  motionToPhotonMs: summary,
});

export const reportSchema = z.object({
  format: z.literal(REPORT_FORMAT),
  version: z.literal(REPORT_VERSION),
  robot: z.object({ id: text, name: text }),
  operator: z.object({ name: text, role: z.nullable(text) }),
  /** ms since the epoch. */
  beganMs: time,
  /** The same; `null` while the session lasts. */
  endedMs: z.nullable(time),
  durationS: number,
  /** Why it ended: a kind of loss, `left` by the operator; `null` while it lasts. */
  end: z.nullable(text),
  driving,
  interventions,
  link,
  view,
  latency,
});

export type SessionReport = z.infer<typeof reportSchema>;
export type ReportInterventions = z.infer<typeof interventions>;
