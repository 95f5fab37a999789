import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import type { Refusal } from '@farpoint/webrtc';
import { SignalingClient } from './admit/signaling/signaling-client.ts';
import { DriveCore } from './drive-core.ts';
import type { TimedBaseState } from './ground/base.ts';
import { monotonicMs } from './ground/clock.ts';
import { RobotCounters } from './ground/robot-counters.ts';
import { StageTimer } from './ground/stage-timer.ts';
import type { VelocitySink } from './ground/velocity-sink.ts';
import type { DriveStation } from './motion/drive/drive-station.ts';
import type { Drive } from './motion/open-drive.ts';
import { type RobotStops, startStops } from './motion/stops/robot-stops.ts';
import { hasSound, type RobotOptions } from './program/robot-configuration.ts';
import { openParts, type RobotParts } from './robot-parts.ts';
import { type CloudSensor, failureReading } from './send/clouds/cloud-sensor.ts';
import type { BaseThread } from './sense/base/base-thread.ts';
import { MOTORS_TOPIC } from './sense/base/sim-topics.ts';
import type { Capture } from './sense/capture/capture.ts';
import { openSessions } from './serve/open-sessions.ts';
import { openReferenceProfile } from './serve/reference/open-reference-profile.ts';
import type { ReferenceProfile } from './serve/reference/reference-profile.ts';
import { RobotStreams } from './serve/robot-streams.ts';
import type { OperatorSession } from './serve/session/operator-session.ts';
import type { OperatorSessions } from './serve/session/operator-sessions.ts';
import { welcome } from './serve/session/welcome.ts';
import { MeasurementLogs } from './tell/measurement-logs.ts';
import { openBoard } from './tell/open-board.ts';
import { RobotReports } from './tell/robot-reports.ts';
import type { SessionRecording } from './tell/session-recording.ts';
import type { TelemetryBoard } from './tell/telemetry-board.ts';
import { TelemetrySender } from './tell/telemetry-sender.ts';

const UPDATE_EVERY_MS = 25;

/** The complete robot: a base, a velocity sink, sensors, operators, and one guard over the wheels. */
export class Robot {
  /** Clouds, pictures, videos and sound. */
  readonly streams: RobotStreams;
  /** `null` if the wheels are not simulated. */
  readonly base: BaseThread | null;
  readonly obstacles: RobotParts['obstacles'];
  readonly sink: VelocitySink;
  readonly signaling: SignalingClient;
  readonly counters = new RobotCounters();
  /** The interface to the reference system's operators; `null` if it is not enabled. */
  reference: ReferenceProfile | null = null;
  readonly sessions: OperatorSessions;
  readonly stops: RobotStops;
  /** `null` if nothing is recorded. */
  readonly recording: SessionRecording | null;
  /** Called if the robot cannot continue. */
  onFailure: ((error: Error) => void) | null = null;
  readonly #options: RobotOptions;
  readonly #log: Logger;
  readonly #logs: MeasurementLogs;
  readonly #core: DriveCore;
  readonly #board: TelemetryBoard;
  readonly #reports: RobotReports;
  readonly #updating: NodeJS.Timeout;
  #state: TimedBaseState | null = null;
  /** When the first sensor's capture thread last gave a sign of life, ms on the robot's clock. */
  #captureSeenMs: number | null = null;

  private constructor(parts: RobotParts, options: RobotOptions, log: Logger) {
    const { base, sink, recording, obstacles } = parts;
    this.recording = recording;
    this.sink = sink;
    this.base = base;
    this.obstacles = obstacles;
    this.#options = options;
    this.#log = log;
    this.#board = openBoard(options, parts.captures[0] as Capture, recording, log);
    this.#logs = new MeasurementLogs(options);
    this.signaling = new SignalingClient({ id: options.id, name: options.name, ...options.signaling }, log);
    const stages = new StageTimer();
    this.streams = this.#openStreams(parts, stages);
    this.#core = this.#openCore(parts);
    this.sessions = this.#openSessions(parts);
    this.signaling.onMessage = (message) => this.sessions.onSignaling(message);
    const addReading = this.#takeReadings(parts);
    const { estop, status } = this.driving;
    this.stops = startStops(options.stops, this.#core.host, estop.start.heldBy, addReading, log);
    this.#reports = new RobotReports({
      operators: this.operators,
      counters: this.counters,
      telemetry: new TelemetrySender(this.operators, status, stages, this.#board, obstacles),
      board: this.#board,
      status,
      recording,
      log,
      state: () => this.#state,
      statisticsFile: options.statisticsFile,
      now: monotonicMs,
    });
    this.#updating = setInterval(() => this.#update(), UPDATE_EVERY_MS);
  }

  /** Opens the sources and connects to the signaling service. @throws {CaptureError} if a source cannot be opened */
  static async start(options: RobotOptions, log: Logger, audit: RobotParts['audit']): Promise<Robot> {
    const robot = new Robot(await openParts(options, log, audit), options, log);
    robot.#begin();
    return robot;
  }

  #begin(): void {
    const { budgets, sendLoop, broadcast } = this.streams;
    this.signaling.start();
    broadcast?.start();
    this.reference = openReferenceProfile(
      this.#options,
      { peer: this.#peerOptions, packetLog: this.#logs.packets, sendLoop, budgets },
      this.#core.host,
      this.#log,
    );
  }

  #openStreams(parts: RobotParts, stages: StageTimer): RobotStreams {
    const log = this.#log;
    const robot = this;
    return new RobotStreams(
      this.#options,
      { ...parts, counters: this.counters, stages, frameLog: this.#logs.frames, log },
      {
        get operators() {
          return robot.operators;
        },
        get reference() {
          return robot.reference;
        },
        get driver() {
          return robot.drive.guard.leaseHolder;
        },
      },
      {
        onState: (state) => {
          this.#captureSeenMs = state.timeMs;
          if (this.base === null) this.#state = this.driving.odometry.take(state);
        },
        onFault: ({ name }, detail) => log.warn({ sensor: name, detail }, 'the source has a fault'),
        onRings: (sensor) => this.#core.host.tellRings(sensor),
        onFailure: (sensor, error) => this.#onSensorFailure(sensor, error),
        onVideosChanged: () => this.#core.host.tellVideos(),
      },
    );
  }

  #openCore(parts: RobotParts): DriveCore {
    const { budgets, sensors, cameras } = this.streams;
    return new DriveCore(this.#options, {
      ...parts,
      budgets,
      counters: this.counters,
      signaling: this.signaling,
      commandLog: this.#logs.commands,
      operators: () => this.operators,
      alsoHeard: () => this.reference?.operator,
      sensors: () => sensors,
      videos: () => cameras.videos,
      now: monotonicMs,
      log: this.#log,
    });
  }

  #openSessions({ grants, robotKey, audit, videos }: RobotParts): OperatorSessions {
    const { sensors, cameras } = this.streams;
    const { host, paths } = this.#core;
    const options = this.#options;
    return openSessions(options, {
      grants,
      robotKey,
      audit,
      peer: {
        ...this.#peerOptions,
        videos: videos.map(({ codecs }) => codecs),
        sound: hasSound(options),
      },
      streams: this.streams,
      host,
      paths,
      packetLog: this.#logs.packets,
      signaling: this.signaling,
      counters: this.counters,
      log: this.#log,
      welcome: (operator) => {
        const { quantities, alarms } = this.#board;
        const told = { ...options, quantities, alarms: alarms.raised, nowS: Date.now() / 1000 };
        welcome(operator, told, sensors, cameras.videos);
      },
    });
  }

  /** Hears what the sources, the wheels and a simulated base tell about themselves. @returns takes one more reading */
  #takeReadings({ captures, sink, base }: RobotParts): (reading: TopicReading) => void {
    const { fix, odometry } = this.driving;
    const board = this.#board;
    const add = (reading: TopicReading) => {
      fix?.take(reading, monotonicMs());
      board.take(reading, monotonicMs());
    };
    for (const each of captures) each.onReading = add;
    sink.tellReadings?.(add);
    if (base !== null) {
      base.onState = (state) => {
        this.#state = odometry.take(state);
      };
      base.onReadings = (told, motors) => {
        told.forEach(add);
        board.sample(MOTORS_TOPIC, motors, monotonicMs());
      };
      base.onFailure = (error) => this.onFailure?.(error);
    }
    return add;
  }

  get operators(): ReadonlyMap<string, OperatorSession> {
    return this.sessions.operators;
  }

  get driving(): Drive {
    return this.#core.driving;
  }

  get drive(): DriveStation {
    return this.driving.station;
  }

  /** Time since the capture thread last gave a sign of life, ms; 0 before the first. */
  get captureSilenceMs(): number {
    return this.#captureSeenMs === null ? 0 : monotonicMs() - this.#captureSeenMs;
  }

  /**
   * Stops the wheels first, then ends all sessions and closes everything.
   *
   * @param isAsked whether somebody wants it to end. After any other end, the next start begins with the emergency stop latched
   */
  async close(isAsked = true): Promise<void> {
    if (isAsked) this.driving.estop.end();
    this.drive.guard.latchEstop('robot');
    this.drive.halt();
    clearInterval(this.#updating);
    const reported = this.#reports.close();
    this.sessions.close();
    this.reference?.close();
    this.drive.close();
    for (const part of [this.sink, this.base]) await part?.close();
    this.streams.sendLoop.close();
    await this.signaling.close();
    const { stops, obstacles, driving, streams, recording } = this;
    for (const part of [stops, obstacles, driving.returns, streams, recording]) await part?.close();
    this.#logs.write();
    await reported;
  }

  /** Options for the connection with any operator. */
  get #peerOptions() {
    const { portRange, icePolicy, connectTimeoutMs } = this.#options;
    const onRefused = (reason: Refusal) => this.counters.datagramsRefused.add(reason);
    return { portRange, icePolicy, connectTimeoutMs, onRefused };
  }

  /** The robot cannot continue without its first sensor. Without another it shows less, but continues. */
  #onSensorFailure(sensor: CloudSensor, error: Error): void {
    if (sensor === this.streams.sensors.first) {
      this.onFailure?.(error);
      return;
    }
    this.#log.error({ err: error, sensor: sensor.name }, 'a sensor has failed: the robot goes on without it');
    this.#board.take(failureReading(sensor), monotonicMs());
    this.streams.budgets.update();
  }

  #update(): void {
    this.#core.update();
    this.sessions.update();
    this.reference?.update();
    this.streams.update();
  }
}
