/** The robot put together: one capture, any number of operators, one guard over the wheels. */
import { randomBytes } from 'node:crypto';
import {
  AdaptiveRateController,
  FixedRateController,
  type RateController,
  ReportRateController,
} from '@farpoint/congestion';
import {
  type Command,
  type DriveLimits,
  type IceServer,
  type LatencyMeasured,
  PROTOCOL_VERSION,
  type ProtocolError,
} from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import { type CommandVerdict, DriveGuard, type RejectedCommand, type TakePolicy } from '@farpoint/safety';
import { fileFault, JsonLinesFile, type Logger } from '@farpoint/service';
import type { Refusal } from '@farpoint/webrtc';
import { Capture, type CaptureError, type CaptureState } from './capture/capture.ts';
import type { CaptureOptions } from './capture/capture-messages.ts';
import { monotonicMs, threadCpuMs } from './clock.ts';
import { DriveStation } from './drive/drive-station.ts';
import { EstopJournal } from './drive/estop-journal.ts';
import { openSink, type SinkOptions, type VelocitySink } from './drive/velocity-sink.ts';
import type { StreamMode } from './encode/stream-mode.ts';
import { PictureHub } from './pictures/picture-hub.ts';
import type { PicturePolicy } from './pictures/picture-plan.ts';
import { ReferenceProfile } from './reference/reference-profile.ts';
import type { ConnectedOperator } from './session/connected-operator.ts';
import { FrameFanOut } from './session/frame-fan-out.ts';
import type { OperatorSession, SessionHost } from './session/operator-session.ts';
import { OperatorSessions } from './session/operator-sessions.ts';
import { PathKeeper } from './session/path-keeper.ts';
import { silenceLimits } from './session/silence.ts';
import { SignalingClient, type SignalingOptions } from './signaling/signaling-client.ts';
import { FrameLog } from './telemetry/frame-log.ts';
import { ReadingBoard } from './telemetry/reading-board.ts';
import { RobotCounters } from './telemetry/robot-counters.ts';
import { type RecordingOptions, SessionRecording } from './telemetry/session-recording.ts';
import { StageTimer } from './telemetry/stage-timer.ts';
import { streamStatistics } from './telemetry/stream-statistics.ts';
import { TelemetrySender } from './telemetry/telemetry-sender.ts';
import { PacketLog } from './transport/packet-log.ts';
import { SendLoop } from './transport/send-loop.ts';

export interface RobotOptions {
  id: string;
  name: string;
  signaling: Pick<SignalingOptions, 'url' | 'key' | 'token' | 'ca'>;
  capture: CaptureOptions;
  /** What moves the wheels. */
  sink: SinkOptions;
  limits: DriveLimits;
  takePolicy: TakePolicy;
  /** Where the robot remembers its emergency stop over restarts. */
  stateFolder: string;
  /** Robots' port of a reference signaling service; its operators prove nothing of themselves. */
  referenceSignaling?: string | undefined;
  /** `auto`: our own coded formats to whoever reads them; `points64`: that to everyone. */
  mode: StreamMode;
  /** The most a stream may take on the wire, bit/s. */
  bitsPerSecond: number;
  /** How the rate of a stream is found: `adaptive`, or always the most, halved on sustained loss. */
  rateControl: 'adaptive' | 'fixed';
  /** What an adaptive rate begins with, bit/s. */
  startBitsPerSecond: number;
  pictures: PicturePolicy;
  maxOperators: number;
  /** An operator of whom nothing is heard for this long is gone, ms. */
  silenceMs: number;
  connectTimeoutMs: number;
  /** Besides those of the signaling service. */
  iceServers: IceServer[];
  portRange?: readonly [number, number] | undefined;
  /** `relay`: media by TURN servers only. */
  icePolicy: 'all' | 'relay';
  /** File for a log of every packet sent, written when the robot closes. */
  packetLog?: string | undefined;
  /** File for a log of every frame, written when the robot closes. */
  frameLog?: string | undefined;
  /** File for what each stream does in each 100 ms, one JSON object a line. */
  statisticsFile?: string | undefined;
  /** What everything is recorded in; left out, nothing is. */
  record?: RecordingOptions | undefined;
}

const TELEMETRY_MS = 50;
const TICK_MS = 25;
const STATISTICS_MS = 100;

export class Robot implements SessionHost {
  readonly capture: Capture;
  readonly drive: DriveStation;
  readonly signaling: SignalingClient;
  readonly counters = new RobotCounters();
  /** Its other face, to the reference system's operators; `null` where it has none. */
  reference: ReferenceProfile | null = null;
  /** `null` where no camera's pictures are to be had. */
  readonly pictures: PictureHub | null;
  /** Called once, where the robot cannot go on. */
  onFailure: ((error: CaptureError) => void) | null = null;
  /** `null` where nothing is recorded. */
  readonly recording: SessionRecording | null;
  readonly #options: RobotOptions;
  readonly #log: Logger;
  readonly #packetLog: PacketLog | undefined;
  readonly #frameLog: FrameLog | undefined;
  readonly #estop: EstopJournal;
  readonly #sink: VelocitySink;
  readonly #sendLoop = new SendLoop(monotonicMs, threadCpuMs);
  readonly #fanOut: FrameFanOut;
  readonly #sessions: OperatorSessions;
  readonly #telemetry: TelemetrySender;
  readonly #paths: PathKeeper;
  readonly #timers: NodeJS.Timeout[] = [];
  readonly #statistics: JsonLinesFile | null = null;
  #state: CaptureState | null = null;
  /** It ends because it must: the next start is latched. */
  #failed = false;

  private constructor(
    capture: Capture,
    sink: VelocitySink,
    recording: SessionRecording | null,
    options: RobotOptions,
    log: Logger,
  ) {
    this.recording = recording;
    this.#options = options;
    this.#log = log;
    this.#packetLog = options.packetLog === undefined ? undefined : new PacketLog(options.packetLog);
    this.#frameLog = options.frameLog === undefined ? undefined : new FrameLog(options.frameLog);
    this.#sink = sink;
    this.capture = capture;
    const guard = new DriveGuard({
      limits: options.limits,
      takePolicy: options.takePolicy,
      randomBytes: (count) => randomBytes(count),
    });
    this.#estop = new EstopJournal(options.stateFolder, options.id, (error) =>
      log.error({ err: error }, 'the emergency stop is not remembered: the next start will be latched'),
    );
    const { latched } = this.#estop.start;
    if (latched !== null) {
      guard.latchEstop(latched.by);
      log.warn(
        { reason: latched.reason, detail: latched.detail },
        'starts with the emergency stop latched: whoever drives must release it',
      );
    }
    this.drive = new DriveStation(
      guard,
      (twist) => {
        sink.apply(twist, guard.estopState().latched);
        recording?.velocity(twist);
      },
      monotonicMs,
    );
    this.signaling = new SignalingClient({ id: options.id, name: options.name, ...options.signaling }, log);
    this.#sessions = new OperatorSessions(
      {
        most: options.maxOperators,
        iceServers: options.iceServers,
        peer: { ...this.#peerOptions, pictures: capture.cameras.length > 0 },
        pictureShare: options.pictures.share,
        makeController: (transportFeedback) => this.#makeController(transportFeedback),
        sendLoop: this.#sendLoop,
        packetLog: this.#packetLog,
        host: this,
        ...{ signaling: this.signaling, counters: this.counters, log },
      },
      {
        resume: (request, iceServers) => void this.#paths.resume(request, iceServers),
        connected: (operator) => this.#welcome(operator),
        budgetChanged: () => this.#fanOut.updateBudget(),
        cloudFormats: (operator) => this.#fanOut.announceTo(operator),
        latencyFrameLost: () => capture.requestLatencyTest(),
        ended: (operator) => this.#operatorGone(operator),
      },
    );
    const stages = new StageTimer();
    const readings = new ReadingBoard();
    this.#telemetry = new TelemetrySender(this.operators, guard, stages, readings);
    const addReading = (reading: TopicReading) => readings.add(reading, monotonicMs());
    capture.onReading = addReading;
    sink.tellReadings?.(addReading);
    this.#fanOut = new FrameFanOut({
      capture,
      targets: () => [...this.operators.values(), ...(this.reference?.targets ?? [])],
      sendLoop: this.#sendLoop,
      driver: () => guard.leaseHolder,
      counters: this.counters,
      frameLog: {
        add: (frame) => {
          this.#frameLog?.add(frame);
          recording?.frame(frame);
        },
      },
      stages,
      now: monotonicMs,
      mayCode: options.mode === 'auto',
    });
    recording?.cameras(capture.cameras);
    this.pictures =
      capture.cameras.length === 0
        ? null
        : new PictureHub({
            policy: options.pictures,
            capture,
            targets: () => this.operators.values(),
            driver: () => guard.leaseHolder,
            onMade: (picture) => recording?.picture(picture),
            log,
          });
    this.#paths = new PathKeeper({
      operators: this.operators,
      limits: silenceLimits(options.silenceMs),
      drive: this.drive,
      signaling: this.signaling,
      leaseChanged: () => this.leaseChanged(),
      counters: this.counters,
      log,
      now: monotonicMs,
    });
    this.signaling.onMessage = (message) => this.#sessions.onSignaling(message);
    this.#sendLoop.onWork = (ms) => this.counters.stageSeconds.add('send', ms / 1000);
    capture.onState = (state) => {
      this.#state = state;
    };
    capture.onFailure = (error) => {
      this.#failed = true;
      this.onFailure?.(error);
    };
    capture.onFault = (detail) => log.warn({ detail }, 'the source has a fault');
    this.#timers.push(setInterval(() => this.#tick(), TICK_MS));
    if (options.statisticsFile !== undefined) {
      this.#statistics = new JsonLinesFile(options.statisticsFile, (error) =>
        log.error(
          { remedy: 'set --stats to a file that can be written' },
          `statistics are not written: ${fileFault(error) ?? error.message}`,
        ),
      );
    }
    if (this.#statistics !== null || recording !== null) {
      this.#timers.push(setInterval(() => this.#writeStatistics(), STATISTICS_MS));
    }
    this.#timers.push(
      setInterval(() => {
        if (this.#state === null) return;
        this.#telemetry.send(this.#state, monotonicMs());
        recording?.telemetry(this.#state, guard, this.operators.size);
      }, TELEMETRY_MS),
    );
  }

  /** Opens the source and begins to call the signaling service. @throws {CaptureError} */
  static async start(options: RobotOptions, log: Logger): Promise<Robot> {
    const recording =
      options.record === undefined ? null : await SessionRecording.open(options.record, options.id, log);
    let capture: Capture;
    try {
      capture = await Capture.start(options.capture, recording?.capture);
    } catch (error) {
      await recording?.close();
      throw error;
    }
    log.info({ source: capture.description }, 'source open');
    recording?.announce(capture, options.capture.framesPerSecond);
    let sink: VelocitySink;
    try {
      sink = openSink(options.sink, capture, log);
    } catch (error) {
      await capture.close();
      await recording?.close();
      throw error;
    }
    const robot = new Robot(capture, sink, recording, options, log);
    robot.signaling.start();
    if (options.referenceSignaling !== undefined) robot.#startReference(options.referenceSignaling);
    return robot;
  }

  get operators(): ReadonlyMap<string, ConnectedOperator> {
    return this.#sessions.operators;
  }

  /** Since the capture thread last gave a sign of life, ms; 0 before the first. */
  get captureSilenceMs(): number {
    return this.#state === null ? 0 : monotonicMs() - this.#state.timeMs;
  }

  /** Stops the wheels first, then takes leave of everyone. */
  async close(): Promise<void> {
    if (!this.#failed) this.#estop.end();
    this.drive.guard.latchEstop('robot');
    this.drive.apply();
    for (const timer of this.#timers) clearInterval(timer);
    this.#sessions.close();
    this.reference?.close();
    this.drive.close();
    await this.#sink.close();
    this.#sendLoop.close();
    await this.signaling.close();
    await this.pictures?.close();
    await this.capture.close();
    await this.recording?.close();
    this.#packetLog?.write();
    this.#frameLog?.write();
    await this.#statistics?.close();
  }

  // SessionHost

  now(): number {
    return monotonicMs();
  }

  leaseChanged(): void {
    for (const operator of this.operators.values()) operator.session.sendLease();
    this.#fanOut.updateBudget();
  }

  estopChanged(): void {
    const { guard } = this.drive;
    const state = guard.estopState();
    this.#estop.changed(state.by ?? null);
    this.#log.warn({ estop: state }, 'emergency stop changed');
    for (const operator of this.operators.values()) operator.session.sendEstop();
  }

  latencyTestRequested(session: OperatorSession, id: number, commandMs: number): void {
    const isNew = this.operators.get(session.id)?.askLatencyTest({ id, commandMs }) ?? false;
    if (isNew) this.capture.requestLatencyTest();
  }

  requestLatencyFrame(): void {
    this.capture.requestLatencyTest();
  }

  commandAccepted(): void {
    this.counters.commandsAccepted++;
  }

  commandRejected(rejection: RejectedCommand): void {
    this.counters.commandsRejected.add(rejection.reason);
  }

  commandJudged(session: OperatorSession, command: Command, verdict: CommandVerdict): void {
    this.recording?.command(session.id, command, verdict);
  }

  latencyMeasured(session: OperatorSession, measured: LatencyMeasured): void {
    this.recording?.latencyMeasured(session.id, measured);
  }

  messageRefused(channel: string, error: ProtocolError): void {
    this.counters.messagesRefused.add(`${channel}:${error.code}`);
    this.#log.debug({ err: error, channel }, 'message refused');
  }

  /** Of a connection with any operator. */
  get #peerOptions() {
    const { portRange, icePolicy, connectTimeoutMs } = this.#options;
    const onRefused = (reason: Refusal) => this.counters.datagramsRefused.add(reason);
    return { portRange, icePolicy, connectTimeoutMs, onRefused };
  }

  #startReference(url: string): void {
    const { name, signaling, iceServers } = this.#options;
    this.reference = new ReferenceProfile(
      {
        url,
        ca: signaling.ca,
        name,
        peer: { ...this.#peerOptions, iceServers },
        makeController: () => this.#makeController(true),
        packetLog: this.#packetLog,
        sendLoop: this.#sendLoop,
        onBudgetChanged: () => this.#fanOut.updateBudget(),
      },
      this,
      this.#log,
    );
  }

  #writeStatistics(): void {
    const lines = streamStatistics(this.operators.values(), this.#state, this.counters, monotonicMs());
    for (const line of lines) this.#statistics?.write(line);
    this.recording?.estimates(lines);
  }

  #makeController(transportFeedback: boolean): RateController {
    const { bitsPerSecond, rateControl, startBitsPerSecond } = this.#options;
    if (rateControl === 'fixed') return new FixedRateController({ bitsPerSecond });
    const options = {
      startBitsPerSecond: Math.min(startBitsPerSecond, bitsPerSecond),
      maxBitsPerSecond: bitsPerSecond,
    };
    return transportFeedback ? new AdaptiveRateController(options) : new ReportRateController(options);
  }

  #welcome(operator: ConnectedOperator): void {
    const { id, name, limits, capture } = this.#options;
    const { width, height } = this.capture.description;
    const { session } = operator;
    session.send({
      type: 'welcome',
      protocol: PROTOCOL_VERSION,
      robotId: id,
      name,
      limits,
      stream: { format: 'points64', width, height, framesPerSecond: capture.framesPerSecond },
      resumeKey: operator.resumeKey.text,
    });
    session.sendLease();
    session.sendEstop();
    const { cameras } = this.capture;
    if (cameras.length > 0) session.send({ type: 'cameras', cameras: cameras.map(({ name }) => ({ name })) });
    this.#fanOut.updateBudget();
  }

  #operatorGone({ session }: ConnectedOperator): void {
    // Its wheels stand before anything else is said.
    const leaseFreed = this.drive.guard.operatorGone(session.id);
    this.drive.apply();
    if (leaseFreed) this.leaseChanged();
    this.#fanOut.updateBudget();
  }

  #tick(): void {
    this.#paths.tick();
    this.reference?.tick();
    this.pictures?.tick(monotonicMs());
    this.#fanOut.updateBudget();
    this.#sendLoop.run();
  }
}
