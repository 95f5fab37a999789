/** How a robot's systems are linked: what each takes from those before it. `robot.ts` calls these in order. */

import type { TimedBaseState } from '@farpoint/cloud-source';
import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import type { Refusal } from '@farpoint/webrtc';
import type { SignalingClient } from './admit/signaling/signaling-client.ts';
import { DriveCore } from './drive-core.ts';
import { monotonicMs } from './ground/clock.ts';
import type { RobotCounters } from './ground/robot-counters.ts';
import { StageTimer } from './ground/stage-timer.ts';
import type { Drive } from './motion/open-drive.ts';
import { stands } from './motion/standing.ts';
import type { RobotStops } from './motion/stops/robot-stops.ts';
import { hasSound, type RobotOptions } from './program/robot-configuration.ts';
import type { RobotParts } from './robot-parts.ts';
import { failureReading } from './send/clouds/cloud-sensor.ts';
import { MOTORS_TOPIC } from './sense/base/sim-topics.ts';
import type { Capture } from './sense/capture/capture.ts';
import { openSessions } from './serve/open-sessions.ts';
import { openReferenceProfile, type ReferenceProfile } from './serve/reference/reference-profile.ts';
import { RobotStreams, type StreamsAudience } from './serve/robot-streams.ts';
import type { OperatorSession } from './serve/session/operator-session.ts';
import type { OperatorSessions } from './serve/session/operator-sessions.ts';
import { robotAbout } from './serve/session/robot-about.ts';
import type { RobotSessionHost } from './serve/session/robot-session-host.ts';
import { welcome } from './serve/session/welcome.ts';
import { tellListedStatus } from './tell/listed-status.ts';
import { MeasurementLogs } from './tell/measurement-logs.ts';
import { openBoard } from './tell/open-board.ts';
import { RobotReports } from './tell/robot-reports.ts';
import { SpanExporter } from './tell/spans/span-exporter.ts';
import type { TelemetryBoard } from './tell/telemetry-board.ts';
import { TelemetrySender } from './tell/telemetry-sender.ts';

/** What all of them have in common. */
export interface RobotContext {
  options: RobotOptions;
  parts: RobotParts;
  signaling: SignalingClient;
  counters: RobotCounters;
  stages: StageTimer;
  logs: MeasurementLogs;
  /** `null`: nothing is exported. */
  spans: SpanExporter | null;
  board: TelemetryBoard;
  log: Logger;
}

export function openContext(
  options: RobotOptions,
  parts: RobotParts,
  { signaling, counters }: Pick<RobotContext, 'signaling' | 'counters'>,
  log: Logger,
): RobotContext {
  const board = openBoard(options, parts.captures[0] as Capture, parts.recording, log);
  const logs = new MeasurementLogs(options.measurementFolder);
  const spans = options.spans === undefined ? null : new SpanExporter(options.spans, log);
  return { options, parts, signaling, counters, stages: new StageTimer(), logs, spans, board, log };
}

/** Sensors, cameras and sound, on their way to those who watch. @param ends what they tell to systems that come later */
export function linkStreams(
  { options, parts, counters, stages, logs, board, log }: RobotContext,
  audience: StreamsAudience,
  ends: {
    host: () => RobotSessionHost;
    onState: (state: TimedBaseState) => void;
    onFailure: (error: Error) => void;
  },
): RobotStreams {
  const streams: RobotStreams = new RobotStreams(
    options,
    { ...parts, counters, stages, frameLog: logs.frames, log },
    audience,
    {
      onState: ends.onState,
      onFault: ({ name }, detail) => log.warn({ sensor: name, detail }, 'the source has a fault'),
      onRings: (sensor) => ends.host().tellRings(sensor),
      onVideosChanged: () => ends.host().tellVideos(),
      onFailure: (sensor, error) => {
        // The robot cannot continue without its first sensor. Without another it shows less, but continues.
        if (sensor === streams.sensors.first) {
          ends.onFailure(error);
          return;
        }
        log.error({ err: error, sensor: sensor.name }, 'a sensor has failed: the robot goes on without it');
        board.take(failureReading(sensor), monotonicMs());
        streams.budgets.update();
      },
    },
  );
  return streams;
}

/** All that decides whether the robot moves. */
export function linkCore(
  { options, parts, counters, signaling, logs, spans, log }: RobotContext,
  { budgets, sensors, cameras }: RobotStreams,
  audience: StreamsAudience,
): DriveCore {
  return new DriveCore(options, {
    ...parts,
    budgets,
    counters,
    signaling,
    commandLog: logs.commands,
    traces: spans?.traces,
    operators: () => audience.operators,
    alsoHeard: () => audience.reference?.operator,
    sensors: () => sensors,
    videos: () => cameras.videos,
    now: monotonicMs,
    log,
  });
}

/** Operators' sessions. */
export function linkSessions(
  context: RobotContext,
  streams: RobotStreams,
  { host, paths, driving }: DriveCore,
): OperatorSessions {
  const { options, parts, signaling, counters, logs, board, log } = context;
  const { grants, robotKey, audit, videos, recording, commands } = parts;
  const about = () => robotAbout(options, recording?.writes ?? false);
  const sessions = openSessions(options, {
    grants,
    robotKey,
    audit,
    commands,
    stands: () => stands(driving),
    peer: {
      ...peerOptions(context),
      videos: videos.map(({ codecs }) => codecs),
      sound: hasSound(options),
    },
    streams,
    host,
    paths,
    packetLog: logs.packets,
    signaling,
    counters,
    log,
    welcome: (operator) => {
      const { quantities, alarms } = board;
      const told = { ...options, about: about(), quantities, alarms: alarms.raised, nowS: Date.now() / 1000 };
      welcome(operator, told, streams.sensors, streams.cameras.videos);
    },
  });
  if (recording !== null)
    recording.onChanged = () => {
      for (const { messages } of sessions.operators.values()) messages.send(about());
    };
  return sessions;
}

/** The interface to the reference system's operators; `null` if it is not enabled. */
export function linkReference(
  context: RobotContext,
  { sendLoop, budgets }: RobotStreams,
  { host }: DriveCore,
): ReferenceProfile | null {
  const { options, logs, log } = context;
  const parts = { peer: peerOptions(context), packetLog: logs.packets, sendLoop, budgets };
  return openReferenceProfile(options, parts, host, log);
}

/** Hears what the sources, the wheels and a simulated base tell about themselves. @returns takes one more reading */
export function linkReadings(
  { parts: { captures, sink, base }, board }: RobotContext,
  { fix, odometry }: Drive,
  ends: { onState: (state: TimedBaseState) => void; onFailure: (error: Error) => void },
): (reading: TopicReading) => void {
  const add = (reading: TopicReading) => {
    fix?.take(reading, monotonicMs());
    board.take(reading, monotonicMs());
  };
  for (const each of captures) each.onReading = add;
  sink.tellReadings?.(add);
  if (base !== null) {
    base.onState = (state) => ends.onState(odometry.take(state));
    base.onReadings = (told, motors) => {
      told.forEach(add);
      board.sample(MOTORS_TOPIC, motors, monotonicMs());
    };
    base.onFailure = ends.onFailure;
  }
  return add;
}

/** What operators are told again and again, and what is measured. */
export function linkReports(
  { parts, counters, stages, logs, board, log }: RobotContext,
  { status }: Drive,
  operators: ReadonlyMap<string, OperatorSession>,
  state: () => TimedBaseState | null,
): RobotReports {
  return new RobotReports({
    operators,
    counters,
    telemetry: new TelemetrySender(operators, status, stages, board, parts.obstacles),
    board,
    status,
    recording: parts.recording,
    log,
    state,
    statisticsFile: logs.statisticsFile,
    now: monotonicMs,
  });
}

/** What the list of robots shows of it. @returns ends it */
export function linkListedStatus(
  { options, signaling, board }: RobotContext,
  { station }: Drive,
  operators: ReadonlyMap<string, OperatorSession>,
  state: () => TimedBaseState | null,
): () => void {
  return tellListedStatus({
    signaling,
    listStatus: options.listStatus,
    version: options.version,
    maxOperators: options.places.most,
    operators,
    guard: station.guard,
    board,
    state,
    now: monotonicMs,
  });
}

/** Options for the connection with any operator. */
function peerOptions({ options, counters }: RobotContext) {
  const { portRange, icePolicy, connectTimeoutMs } = options;
  const onRefused = (reason: Refusal) => counters.datagramsRefused.add(reason);
  return { portRange, icePolicy, connectTimeoutMs, onRefused };
}

/** Closes what is left once the wheels stand and the sessions have ended. */
export async function closeLinked(
  { parts: { sink, base, obstacles, recording }, signaling, logs, spans }: RobotContext,
  streams: RobotStreams,
  { returns }: Drive,
  stops: RobotStops,
): Promise<void> {
  for (const part of [sink, base]) await part?.close();
  streams.sendLoop.close();
  await signaling.close();
  for (const part of [stops, obstacles, returns, streams, recording, spans]) await part?.close();
  logs.write();
}
