/** An operator's connection to robots. */
import {
  type Command,
  NO_LEASE,
  type OperatorSessionMessage,
  type RobotListing,
  type Telemetry,
} from '@farpoint/protocol';
import type { Batch } from '../cloud/batch.ts';
import { ReadableFormats } from '../cloud/readable-formats.ts';
import { RobotCommands } from '../commands/robot-commands.ts';
import { Driver } from '../drive/driver.ts';
import { presentRobot, RobotSwitch } from '../drive/robot-switch.ts';
import { SeenView } from '../drive/seen-view.ts';
import type { DriveWish } from '../drive/velocity-mapping.ts';
import { WishInput } from '../drive/wish-input.ts';
import type { AgeOfStamp } from '../latency/frame-latency.ts';
import { LatencyProbe, type LatencyReport } from '../latency/latency-probe.ts';
import type { RobotLink } from '../link/robot-link.ts';
import type { SessionPhase } from '../session/session-keeper.ts';
import type { RobotSound } from '../sound/robot-sound.ts';
import { StreamStatistics, type StreamStats } from '../statistics/stream-statistics.ts';
import { StopDelivery } from '../stop/stop-delivery.ts';
import type { RobotClientOptions } from './client-options.ts';
import { clientParts, openLink } from './client-parts.ts';
import { type ClientParts, linkEvents } from './link-events.ts';
import { PeopleRequests } from './people-requests.ts';
import type { RobotEvents } from './robot-events.ts';

/**
 * How often the client's clocks are looked at, ms: as often as commands leave (command-stream.ts); and how
 * often statistics are told: as often as people can read.
 */
const [UPDATE_EVERY_MS, STATISTICS_MS] = [25, 250];

/**
 * An operator's connection to robots. Events report what robots send; methods send what the operator wants. Use
 * {@link connect} to drive one robot. Use this class directly if an app has its own input devices.
 */
export class RobotClient {
  /** The link itself: signaling state, session state, and what the robot has sent in this session. */
  readonly link: RobotLink;
  /** Which device drives, and who holds the lease. */
  readonly driver: Driver;
  /** Asks for the drive, and offers it. */
  readonly people: PeopleRequests;
  /** What the robot can be made to do besides driving: lights, docking, a recording. */
  readonly commands: RobotCommands;
  /** What is on the operator's screen, which each command tells the robot. */
  readonly seen = new SeenView();
  /** Gets STOP to the robot. */
  readonly stops: StopDelivery;
  /** Runs latency tests. */
  readonly latency: LatencyProbe;
  /** Listening to the robot, and speaking to it. */
  readonly sound: RobotSound;
  /** Statistics of the stream. */
  readonly statistics: StreamStatistics;
  /** When points last arrived or the session's phase last changed, `performance.now()`. */
  pointsAtMs = 0;
  readonly #parts: ClientParts;
  readonly #emitter: ClientParts['emitter'];
  readonly #wish = new WishInput();
  readonly #switch: RobotSwitch;
  #timer: ReturnType<typeof setInterval> | undefined;
  #statisticsDueMs = 0;
  #closed = false;

  /** Makes a client that does nothing until {@link start} is called. */
  constructor(options: RobotClientOptions) {
    const ageOf: AgeOfStamp = (stampUs, nowMs) => this.link.session.ageMs(stampUs, nowMs);
    this.#parts = clientParts({
      formats: new ReadableFormats(options.cloudFormats),
      ageOf,
      send: (message) => this.link.sendSession(message),
      onBatch: (batch) => this.#onBatch(batch),
      onReport: (report) => {
        this.statistics.onReport(report);
        this.link.sendReport(report);
      },
    });
    this.#emitter = this.#parts.emitter;
    this.statistics = new StreamStatistics(ageOf);
    this.sound = this.#parts.sound;
    this.link = openLink(options, this.#parts.receiver.worker, linkEvents(this, this.#parts));
    this.driver = new Driver([...(options.inputs ?? []), this.#wish], {
      sendCommand: (command) => this.#sendCommand(command),
      sendSession: (message) => this.link.sendSession(message),
      onOtherDrives: () => this.#emitter.emit('otherDrives', undefined),
      onGripLost: (loss) => this.#emitter.emit('gripLost', loss),
      onGripMissing: (device) => this.#emitter.emit('gripMissing', device),
    });
    this.people = new PeopleRequests(this.link);
    this.commands = new RobotCommands({
      send: (request) => this.#request(request),
      onChange: (commands) => this.#emitter.emit('commands', commands),
      onEnd: (end) => this.#emitter.emit('commandEnd', end),
    });
    this.stops = new StopDelivery(this.link, (status) => this.#emitter.emit('stop', status));
    this.latency = new LatencyProbe(this.link, this.driver, (result) => {
      this.statistics.onResult(result);
      const { id, frameNumber, mtpMs, firstMs } = result;
      this.link.sendSession({ type: 'latencyMeasured', id, frameNumber, mtpMs, firstMs });
      this.#emitter.emit('latency', result);
    });
    this.#switch = new RobotSwitch({
      letGo: () => this.driver.letGo(performance.now()),
      connect: (robotId) => this.link.connect(robotId),
    });
  }

  /** Calls `listener` for each event of the type ({@link RobotEvents}). @returns a function that removes it */
  on<Type extends keyof RobotEvents>(type: Type, listener: (event: RobotEvents[Type]) => void): () => void {
    return this.#emitter.on(type, listener);
  }

  /** Connects to the signaling service, and stays connected. */
  start(): void {
    if (this.#closed) return;
    this.link.start();
    this.#timer ??= setInterval(() => this.update(performance.now()), UPDATE_EVERY_MS);
  }

  /** Ends the session and frees everything. The client cannot be started again. */
  close(): void {
    this.#closed = true;
    clearInterval(this.#timer);
    this.#wish.release();
    this.driver.letGo(performance.now());
    this.latency.fail('no-session');
    this.link.close();
    this.#parts.receiver.close();
    this.#parts.pictures.close();
  }

  /** The phase of the session with the chosen robot. */
  get phase(): SessionPhase {
    return this.link.phase;
  }

  /** The robots that the service lists now. */
  get robots(): readonly RobotListing[] {
    return this.link.robots;
  }

  /** The robot that this client is connected to, or will be once the present one has stopped. */
  get chosenRobotId(): string | null {
    return this.#switch.target ?? this.link.robotId;
  }

  /** The robot's latest telemetry in this session. */
  get telemetry(): Telemetry | null {
    return this.link.session.telemetry;
  }

  /** Connects to this robot once it is listed, and whenever the session is lost. The present robot stops first. */
  choose(robotId: string): void {
    if (this.#closed) return;
    this.#switch.choose(robotId, presentRobot(this.link, this.driver.holder), performance.now());
  }

  /** Ends the session on purpose: a robot that drives back after a loss stays. The client stays connected to the service. */
  leave(): void {
    this.#switch.cancel();
    if (this.link.phase === 'live') this.driver.letGo(performance.now());
    this.link.disconnect();
  }

  /**
   * Moves the robot. Call it again at least every 200 ms while the operator holds on: a wish that is not renewed
   * expires, and the robot stops. The first call requests the lease if nobody drives. A wish that outlives a session or
   * a lost path moves nothing until it has expired once.
   */
  drive(wish: DriveWish): void {
    const nowMs = performance.now();
    this.#wish.renew(wish, nowMs);
    this.driver.sendDue(nowMs);
  }

  /** Stops at once, without waiting for the wish to expire. The operator keeps the lease. */
  stop(): void {
    this.#wish.release();
    this.driver.sendDue(performance.now());
  }

  /** Takes over from another operator. */
  takeOver(): void {
    this.driver.requestLease(true);
  }

  /**
   * Latches the emergency stop, which only {@link releaseEstop} releases. Sent until the robot confirms it, and kept for
   * up to 60 s without a session; the `stop` event says what has become of it.
   * @returns false if no robot is chosen
   */
  estop(): boolean {
    return this.stops.press(performance.now());
  }

  /**
   * Asks the robot to release the emergency stop, as it is known here: it stays latched if STOP was pressed again in the
   * meantime. If nobody drives, this requests the lease first. Call it only for a deliberate act, e.g. a button held for
   * a second. An own STOP that is not yet confirmed is still delivered.
   * @returns whether it was sent, which needs a session. The `estop` event confirms it.
   */
  releaseEstop(): boolean {
    if (this.link.phase === 'live' && this.driver.holder === 'nobody') this.driver.requestLease(false);
    return this.#request({ type: 'estop', latch: false, of: this.link.session.estop.latch });
  }

  /**
   * Ends another operator's session. Only a supervisor may; others get the robot's `robotFault`.
   * @param operator its `number` in the `operators` event
   * @param options.block also makes the robot refuse that operator's grant until it ends
   * @returns whether it was sent, which needs a session. The `operators` event confirms it.
   */
  endSession(operator: number, options: { block?: boolean } = {}): boolean {
    return this.#request({ type: 'endSession', operator, block: options.block === true });
  }

  /** Asks for pictures of these cameras only: indices into the list of the `cameras` event. */
  watch(cameras: readonly number[]): void {
    this.#parts.pictures.watch(cameras);
    this.link.sendSession({ type: 'pictures', cameras: [...cameras] });
  }

  /**
   * Asks for these videos only: indices into the list of the `videos` event. Initially none.
   * @param barcode whether the robot draws the capture time into their pictures, for everyone: to measure latency
   */
  watchVideos(videos: readonly number[], barcode = false): void {
    this.link.sendSession({ type: 'videos', videos: [...videos], ...(barcode ? { barcode } : {}) });
  }

  /**
   * Divides the link where clouds and videos want more than it carries: weights from 1 to 100, of all clouds together (2
   * at the start of each session) and of each video of the `videos` event (1).
   */
  shareLink(cloud: number, videos: readonly number[]): void {
    this.link.sendSession({ type: 'shares', cloud, videos: [...videos] });
  }

  /** Asks for the clouds of these sensors only: indices into the list of the `sensors` event. Initially the first. */
  wantClouds(sensors: readonly number[]): void {
    this.link.sendSession({ type: 'sensors', sensors: [...sensors] });
  }

  /**
   * Measures motion to photon: the time until a green cloud that is requested now has been drawn. Whatever draws the
   * clouds must call {@link noteUploaded} and {@link noteDrawn}, as `CloudView` of `@farpoint/cloud-view` does.
   * @param startedAtMs when the operator acted, `performance.now()`
   * @throws {LatencyError} if there is no session, another test runs, somebody else drives, or no frame came within 3 s
   */
  latencyTest(startedAtMs = performance.now()): Promise<LatencyReport> {
    return this.latency.run(startedAtMs);
  }

  /** Asks the robot to send at most this rate, bit/s. No effect through a bridge. */
  limitBandwidth(bitsPerSecond: number): void {
    this.link.limitBandwidth(bitsPerSecond);
  }

  /** Draws only one of every N points: one N for coded clouds, and one for `points64`, which is already a sample. */
  drawEvery(every: number, everySample = 1): void {
    this.#parts.receiver.drawEvery(every, everySample);
  }
  /** Whether clouds on a camera's grid come as tiles of a surface, from their next frame on. Default: as points. */
  drawSurface(wanted: boolean): void {
    this.#parts.receiver.drawSurface(wanted);
  }

  /** The stream's present rates, losses, round trips and latencies. */
  stats(): StreamStats {
    return this.statistics.snapshot(this.link.session.clock);
  }

  /** Returns a batch of a `cloud` event to the worker. Its buffer is detached afterwards. */
  release(batch: Batch): void {
    this.#parts.receiver.release(batch);
  }

  /** A packet's points were uploaded for the display frame being prepared. */
  noteUploaded(batch: Batch, packet: number): void {
    this.statistics.onUploaded(batch, packet, performance.now());
    this.seen.onUploaded(batch, packet);
    // Only the first sensor answers latency tests.
    if (batch.sensor === 0) this.latency.onPacket(batch, packet);
  }

  /** The display frame with the points of {@link noteUploaded} is finished. @param nowMs `performance.now()` */
  noteDrawn(nowMs: number): void {
    this.seen.onDrawn();
    this.latency.onDrawn(nowMs);
    this.statistics.onDrawn(nowMs);
  }

  /**
   * Sends what is due: commands, an emergency stop that is not confirmed yet, a latency test's request. The client's own
   * timer calls it; an app that has just read its devices calls it at once.
   *
   * @param nowMs `performance.now()`
   */
  update(nowMs: number): void {
    this.#wish.lapse(nowMs);
    this.stops.sendDue(nowMs);
    this.commands.tick(nowMs);
    this.driver.sendDue(nowMs);
    this.#switch.decide(presentRobot(this.link, this.driver.holder), nowMs);
    this.latency.sendDue(nowMs);
    if (nowMs < this.#statisticsDueMs) return;
    this.#statisticsDueMs = nowMs + STATISTICS_MS;
    this.statistics.update(nowMs);
  }

  #onBatch(batch: Batch): void {
    const type = batch.sensor === 0 ? 'cloud' : (`cloud:${batch.sensor}` as const);
    if (!this.#emitter.emit(type, batch)) this.release(batch);
    this.pointsAtMs = performance.now();
    this.link.onPoints(this.pointsAtMs);
  }

  #sendCommand(command: Command): void {
    const madeMs = performance.now();
    this.link.sendCommand(this.seen.stamp(command));
    // The robot answers none that only says that the hand is open.
    if (command.lease === NO_LEASE) return;
    this.statistics.commands.onSent(command.sequence, command.timeMs, madeMs, performance.now());
  }

  /** Sends what only a session can take. */
  #request(message: OperatorSessionMessage): boolean {
    if (this.link.phase !== 'live') return false;
    this.link.sendSession(message);
    return true;
  }
}
