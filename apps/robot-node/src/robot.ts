import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import type { Refusal } from '@farpoint/webrtc';
import { SignalingClient } from './admit/signaling/signaling-client.ts';
import { DriveCore } from './drive-core.ts';
import type { TimedBaseState } from './ground/base.ts';
import { monotonicMs, threadCpuMs } from './ground/clock.ts';
import { RobotCounters } from './ground/robot-counters.ts';
import { StageTimer } from './ground/stage-timer.ts';
import type { VelocitySink } from './ground/velocity-sink.ts';
import type { DriveStation } from './motion/drive/drive-station.ts';
import type { Drive } from './motion/open-drive.ts';
import { type RobotStops, startStops } from './motion/stops/robot-stops.ts';
import { hasSound, type RobotOptions } from './program/robot-configuration.ts';
import { openParts, type RobotParts } from './robot-parts.ts';
import { Budgets } from './send/budgets/budgets.ts';
import { type CloudSensor, failureReading } from './send/clouds/cloud-sensor.ts';
import { CloudSensors } from './send/clouds/cloud-sensors.ts';
import { RobotSound } from './send/sound/robot-sound.ts';
import { makeRateController } from './send/transport/make-rate-controller.ts';
import { SendLoop } from './send/transport/send-loop.ts';
import type { BaseThread } from './sense/base/base-thread.ts';
import { MOTORS_TOPIC } from './sense/base/sim-topics.ts';
import type { Capture } from './sense/capture/capture.ts';
import { openSoundDevices } from './sense/sound/open-sound-devices.ts';
import type { Broadcast } from './serve/broadcast/broadcast.ts';
import { openBroadcast } from './serve/broadcast/open-broadcast.ts';
import { openReferenceProfile } from './serve/reference/open-reference-profile.ts';
import type { ReferenceProfile } from './serve/reference/reference-profile.ts';
import { RobotCameras } from './serve/robot-cameras.ts';
import type { OperatorSession } from './serve/session/operator-session.ts';
import { OperatorSessions } from './serve/session/operator-sessions.ts';
import type { RobotSessionHost } from './serve/session/robot-session-host.ts';
import { welcome } from './serve/session/welcome.ts';
import { MeasurementLogs } from './tell/measurement-logs.ts';
import { openBoard } from './tell/open-board.ts';
import { RobotReports } from './tell/robot-reports.ts';
import type { SessionRecording } from './tell/session-recording.ts';
import type { TelemetryBoard } from './tell/telemetry-board.ts';
import { TelemetrySender } from './tell/telemetry-sender.ts';

const TICK_MS = 25;

/** The complete robot: a base, a velocity sink, sensors, operators, and one guard over the wheels. */
export class Robot {
  readonly sensors: CloudSensors;
  /** `null` if the wheels are not simulated. */
  readonly base: BaseThread | null;
  readonly drive: DriveStation;
  readonly obstacles: RobotParts['obstacles'];
  readonly driving: Drive;
  readonly sink: VelocitySink;
  readonly signaling: SignalingClient;
  readonly counters = new RobotCounters();
  /** The interface to the reference system's operators; `null` if it is not enabled. */
  reference: ReferenceProfile | null = null;
  readonly cameras: RobotCameras;
  readonly sound: RobotSound;
  readonly sessions: OperatorSessions;
  readonly stops: RobotStops;
  /** What feeds viewers through a relay; `null` if it is not enabled. */
  readonly broadcast: Broadcast | null;
  /** Called if the robot cannot continue. */
  onFailure: ((error: Error) => void) | null = null;
  /** `null` if nothing is recorded. */
  readonly recording: SessionRecording | null;
  readonly #options: RobotOptions;
  readonly #log: Logger;
  readonly #logs: MeasurementLogs;
  readonly #host: RobotSessionHost;
  readonly #sendLoop = new SendLoop(monotonicMs, threadCpuMs);
  readonly #core: DriveCore;
  readonly #budgets: Budgets;
  readonly #board: TelemetryBoard;
  readonly #reports: RobotReports;
  readonly #ticking: NodeJS.Timeout;
  #state: TimedBaseState | null = null;
  /** When the first sensor's capture thread last gave a sign of life, ms on the robot's clock. */
  #captureSeenMs: number | null = null;

  private constructor(parts: RobotParts, options: RobotOptions, log: Logger) {
    const { captures, base, sink, recording, videos, grants, robotKey, audit } = parts;
    this.recording = recording;
    this.sink = sink;
    this.base = base;
    this.#options = options;
    this.#log = log;
    const capture = captures[0] as Capture;
    this.#board = openBoard(options, capture, recording, log);
    this.#logs = new MeasurementLogs(options);
    const state = () => this.#state;
    this.signaling = new SignalingClient({ id: options.id, name: options.name, ...options.signaling }, log);
    const watching = () => [...this.operators.values(), ...(this.broadcast === null ? [] : [this.broadcast])];
    const targets = () => [...watching(), ...(this.reference?.targets ?? [])];
    this.#budgets = new Budgets({
      targets,
      driver: () => this.drive.guard.leaseHolder,
      mayCode: options.mode === 'auto',
    });
    this.#core = new DriveCore(options, {
      ...parts,
      budgets: this.#budgets,
      counters: this.counters,
      signaling: this.signaling,
      commandLog: this.#logs.commands,
      operators: () => this.operators,
      alsoHeard: () => this.reference?.operator,
      sensors: () => this.sensors,
      videos: () => this.cameras.videos,
      now: monotonicMs,
      log,
    });
    const { driving, host } = this.#core;
    const { station, estop, status, fix } = driving;
    this.driving = driving;
    this.drive = station;
    this.obstacles = parts.obstacles;
    this.#host = host;
    this.sessions = new OperatorSessions(
      {
        id: options.id,
        places: options.places,
        iceServers: options.iceServers,
        grants,
        robotKey,
        peer: {
          ...this.#peerOptions,
          pictures: capture.cameras.length > 0,
          videos: videos.map(({ codecs }) => codecs),
          sound: hasSound(options),
        },
        pictureShare: options.pictures.share,
        makeController: (transportFeedback) => makeRateController(options, transportFeedback),
        claims: () => this.sensors.claims,
        budgets: this.#budgets,
        mostVideoBitsPerSecond: (video, codecs) => this.cameras.videos.mostBitsPerSecond(video, codecs),
        sendLoop: this.#sendLoop,
        packetLog: this.#logs.packets,
        host: this.#host,
        signaling: this.signaling,
        counters: this.counters,
        audit,
        log,
      },
      {
        resume: (request, iceServers) => void this.#core.paths.resume(request, iceServers),
        connected: (operator) => {
          const { quantities, alarms } = this.#board;
          const told = { ...options, quantities, alarms: alarms.raised, nowS: Date.now() / 1000 };
          welcome(operator, told, this.sensors, this.cameras.videos);
          this.sound.welcome(operator);
          this.#budgets.update();
        },
        cloudFormats: (operator) => this.sensors.announceTo(operator),
        needsKeyFrame: (video) => this.cameras.videos.requestKeyFrame(video),
        latencyFrameLost: () => capture.requestLatencyTest(),
        ended: ({ id }, end) => this.#host.operatorGone(id, end),
        left: (id) => this.#host.driverLeaves({ id }),
      },
    );
    const [stages, board] = [new StageTimer(), this.#board];
    const telemetry = new TelemetrySender(this.operators, status, stages, board, this.obstacles);
    const addReading = (reading: TopicReading) => {
      fix?.take(reading, monotonicMs());
      board.take(reading, monotonicMs());
    };
    for (const each of captures) each.onReading = addReading;
    sink.tellReadings?.(addReading);
    this.stops = startStops(options.stops, this.#host, estop.start.heldBy, addReading, log);
    this.sensors = new CloudSensors(
      options.sensors,
      captures,
      {
        targets,
        sendLoop: this.#sendLoop,
        counters: this.counters,
        frameLog: this.#logs.frames,
        onFrame: (frame) => recording?.frame(frame),
        wantedAnyway: () => recording?.wantsClouds === true,
        stages,
        now: monotonicMs,
      },
      this.#budgets,
      {
        onState: (state) => {
          this.#captureSeenMs = state.timeMs;
          if (base === null) this.#state = this.driving.odometry.take(state);
        },
        onFault: ({ name }, detail) => log.warn({ sensor: name, detail }, 'the source has a fault'),
        onRings: (sensor) => this.#host.tellRings(sensor),
        onFailure: (sensor, error) => this.#onSensorFailure(sensor, error),
      },
    );
    recording?.cameras(capture.cameras, videos, (video) => this.cameras.videos.requestKeyFrame(video));
    const shared = {
      targets: () => this.operators.values(),
      driver: () => station.guard.leaseHolder,
      onFrame: () => this.#sendLoop.run(),
      log,
    };
    this.cameras = new RobotCameras({
      ...shared,
      policy: options.pictures,
      capture,
      videos,
      taker: recording,
      videoTargets: watching,
      onMade: (picture) => recording?.picture(picture),
      onStateChanged: () => {
        this.#host.tellVideos();
        this.broadcast?.videosChanged();
      },
    });
    const devices = openSoundDevices(options.sound, log);
    this.sound = new RobotSound({ ...shared, devices, now: monotonicMs });
    this.broadcast = openBroadcast(options, this, {
      videos,
      sendLoop: this.#sendLoop,
      budgets: this.#budgets,
      log,
    });
    this.signaling.onMessage = (message) => this.sessions.onSignaling(message);
    this.#sendLoop.onWork = (ms) => this.counters.stageSeconds.add('send', ms / 1000);
    if (base !== null) {
      base.onState = (state) => {
        this.#state = this.driving.odometry.take(state);
      };
      base.onReadings = (told, motors) => {
        told.forEach(addReading);
        board.sample(MOTORS_TOPIC, motors, monotonicMs());
      };
      base.onFailure = (error) => this.onFailure?.(error);
    }
    this.#ticking = setInterval(() => this.#tick(), TICK_MS);
    this.#reports = new RobotReports({
      operators: this.operators,
      counters: this.counters,
      telemetry,
      board,
      status,
      recording,
      log,
      state,
      statisticsFile: options.statisticsFile,
      now: monotonicMs,
    });
  }

  /** Opens the sources and connects to the signaling service. @throws {CaptureError} if a source cannot be opened */
  static async start(options: RobotOptions, log: Logger, audit: RobotParts['audit']): Promise<Robot> {
    const robot = new Robot(await openParts(options, log, audit), options, log);
    robot.#begin();
    return robot;
  }

  #begin(): void {
    this.signaling.start();
    this.broadcast?.start();
    this.reference = openReferenceProfile(
      this.#options,
      {
        peer: this.#peerOptions,
        packetLog: this.#logs.packets,
        sendLoop: this.#sendLoop,
        budgets: this.#budgets,
      },
      this.#host,
      this.#log,
    );
  }

  get operators(): ReadonlyMap<string, OperatorSession> {
    return this.sessions.operators;
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
    clearInterval(this.#ticking);
    const reported = this.#reports.close();
    this.sessions.close();
    this.reference?.close();
    const broadcastClosed = this.broadcast?.close();
    this.drive.close();
    for (const part of [this.sink, this.base]) await part?.close();
    this.#sendLoop.close();
    await this.signaling.close();
    await broadcastClosed;
    const { stops, obstacles, driving, cameras, sound, sensors, recording } = this;
    for (const part of [stops, obstacles, driving.returns, cameras, sound, sensors, recording])
      await part?.close();
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
    if (sensor === this.sensors.first) {
      this.onFailure?.(error);
      return;
    }
    this.#log.error({ err: error, sensor: sensor.name }, 'a sensor has failed: the robot goes on without it');
    this.#board.take(failureReading(sensor), monotonicMs());
    this.#budgets.update();
  }

  #tick(): void {
    this.#core.tick();
    this.sessions.tick();
    this.reference?.tick();
    this.broadcast?.tick();
    this.cameras.tick(monotonicMs());
    this.sound.tick();
    this.#budgets.update();
    this.#sendLoop.run();
  }
}
