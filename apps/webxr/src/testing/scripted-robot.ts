/**
 * A robot of which a script says everything. By default it admits everybody, answers as a robot does, moves as it is told,
 * and sends telemetry 20 times a second.
 */
import type {
  LinkScript,
  ScriptedLink,
  SentMessage,
  ToldMessage,
} from '@farpoint/operator/testing/scripted-link';
import type {
  EstopCause,
  EstopState,
  LeaseState,
  Pose,
  RobotBody,
  Telemetry,
  Twist,
  Welcome,
} from '@farpoint/protocol';
import { ScriptedPeople } from './scripted-people.ts';

const TELEMETRY_MS = 50;
/** From the request to the session, ms. */
const ADMISSION_MS = 20;
/** The robot's clock is ahead of the page's by this, ms. */
const AHEAD_MS = 5000;
const LEASE = 'lease-1';

export class ScriptedRobot implements LinkScript {
  id = 'stage-1';
  name = 'Robot on a stage';
  limits: Welcome['limits'] = {
    ...{ maxLinear: 0.5, maxAngular: 1, watchdogMs: 150, maxCommandsPerSecond: 100 },
    ...{ afterGap: 'let-go', resumeWithinMs: 300 },
  };
  body: RobotBody | undefined = {
    footprint: [
      { x: 0.3, y: 0.25 },
      { x: -0.3, y: 0.25 },
      { x: -0.3, y: -0.25 },
      { x: 0.3, y: -0.25 },
    ],
    ...{ decelerationMps2: 1, accelerationMps2: 1, turnRadps2: 2 },
  };
  /** Sent after the welcome of each session. */
  greeting: ToldMessage[] = [];
  /** What each telemetry message has instead of what the robot would say. */
  telemetry: Partial<Telemetry> = {};
  access: Welcome['access'];
  lease: LeaseState = { type: 'lease', holder: 'nobody' };
  estop: EstopState = { type: 'estop', latched: false, latch: 0 };
  /** What it says about its emergency stop besides that, if an operator has not pressed STOP here. */
  cause: Omit<EstopCause, 'type' | 'latch'> = { yours: false, release: 'driver' };
  /** Whether it opens the sessions that are asked for. */
  admits = true;
  /** Whether it does what it is asked. Clock probes are answered anyway. */
  obeys = true;
  /** Whether its telemetry goes on. */
  reports = true;
  /** How long each message is on its way, in either direction, ms. */
  delayMs = 0;
  pose: { x: number; y: number; z: number; yaw: number } = { x: 0, y: 0, z: 0, yaw: 0 };
  velocity = { linear: 0, lateral: 0, angular: 0 };
  /** The other operators. */
  readonly people = new ScriptedPeople(this);
  #link: ScriptedLink | null = null;
  #sequence = 0;
  #commandMs = Number.NEGATIVE_INFINITY;
  #wish: Twist | null = null;
  #timer: ReturnType<typeof setInterval> | undefined;

  /** The robot's clock, ms. */
  get nowMs(): number {
    return performance.now() + AHEAD_MS;
  }

  /** Where base_link is. */
  get placed(): Pose {
    const { x, y, z, yaw } = this.pose;
    const orientation = { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) };
    return { position: { x, y, z }, orientation };
  }

  /** The robot is listed by the service, which is there. */
  appear(link: ScriptedLink): void {
    this.#link = link;
    this.#timer ??= setInterval(() => this.#advance(), TELEMETRY_MS);
    link.enterSignaling('ready');
    link.list([{ id: this.id, name: this.name }]);
  }

  onRequest(): void {
    if (this.admits) setTimeout(() => this.#greet(), ADMISSION_MS);
  }

  onSent(message: SentMessage): void {
    this.#later(() => this.#take(message));
  }

  /** Sends a message, which is on its way for a while. */
  tell(message: ToldMessage): void {
    this.#later(() => this.#link?.tell(message));
  }

  /** Somebody has the lease now. */
  giveLease(holder: LeaseState['holder'], driver?: string): void {
    this.lease = { type: 'lease', holder, ...(holder === 'you' ? { lease: LEASE } : {}) };
    if (driver !== undefined) this.lease.driver = driver;
    this.tell(this.lease);
    this.people.list();
  }

  /** The emergency stop is in this state now. @param cause who or what stopped it, and who may release that */
  stop(state: Partial<EstopState>, cause: Partial<ScriptedRobot['cause']> = {}): void {
    this.estop = { ...this.estop, ...state };
    this.cause = { ...this.cause, ...cause };
    this.#tellStop();
  }

  #tellStop(): void {
    const { latched, latch } = this.estop;
    if (latched && latch !== undefined) this.tell({ type: 'estopCause', latch, ...this.cause });
    this.tell(this.estop);
    if (latched) this.people.interrupt('estop');
  }

  #later(act: () => void): void {
    if (this.delayMs === 0) act();
    else setTimeout(act, this.delayMs);
  }

  #greet(): void {
    const link = this.#link;
    if (link?.phase !== 'opening') return;
    link.admit();
    this.lease = this.lease.holder === 'other' ? this.lease : { type: 'lease', holder: 'nobody' };
    const { name, id: robotId, limits, body, access } = this;
    const stream = { format: 'points64', width: 320, height: 240, framesPerSecond: 10 } as const;
    const welcome: Welcome = { type: 'welcome', protocol: 1, robotId, name, limits, stream };
    if (body !== undefined) welcome.body = body;
    if (access !== undefined) welcome.access = access;
    for (const message of [welcome, this.lease]) this.tell(message);
    this.#tellStop();
    for (const message of this.greeting) this.tell(message);
    this.people.list();
    this.#report();
  }

  #take(message: SentMessage): void {
    if (message.type === 'clockProbe') {
      const { id, sentMs } = message;
      this.tell({ type: 'clockAnswer', id, sentMs, robotMs: this.nowMs });
      return;
    }
    if (!this.obeys) return;
    switch (message.type) {
      case 'leaseRequest':
        if (this.lease.holder === 'nobody' || message.take) this.giveLease('you');
        return;
      case 'leaseRelease':
        if (this.lease.holder === 'you') this.giveLease('nobody');
        return;
      case 'estop':
        if (!('latch' in message)) this.#press(message.press);
        else if (message.latch) this.#press(message.press);
        else if (message.of === undefined || message.of === this.estop.latch) this.#release();
        return;
      case 'command':
        this.#commandMs = performance.now();
        this.#wish = message.lease === LEASE ? message.twist : null;
        return;
      case 'driveAsk':
        this.people.request('ask', undefined);
        return;
      case 'driveOffer':
        this.people.request('offer', message.to);
        return;
      case 'driveAnswer':
        this.people.close(message.id, message.accept ? 'accepted' : 'refused');
        return;
      case 'driveWithdraw':
        this.people.close(message.id, 'withdrawn');
    }
  }

  /** A press that comes again is acknowledged again. */
  #press(press: number | undefined): void {
    const isRepeat = press !== undefined && press === this.estop.press;
    if (!isRepeat)
      this.stop(
        {
          ...{ latched: true, by: 'operator', latch: (this.estop.latch ?? 0) + 1 },
          ...(press === undefined ? {} : { press }),
        },
        { yours: true },
      );
    if (press !== undefined) this.tell({ type: 'estopAck', press });
  }

  #release(): void {
    if (this.estop.releasedAt === 'robot') return;
    const { latch = 0, press } = this.estop;
    this.estop = { type: 'estop', latched: false, latch, ...(press === undefined ? {} : { press }) };
    this.tell(this.estop);
  }

  #advance(): void {
    const fresh = performance.now() - this.#commandMs < this.limits.watchdogMs;
    const wish = fresh && !this.estop.latched && this.lease.holder === 'you' ? this.#wish : null;
    this.velocity = {
      linear: wish?.linear.x ?? 0,
      lateral: wish?.linear.y ?? 0,
      angular: wish?.angular.z ?? 0,
    };
    const { pose, velocity } = this;
    const seconds = TELEMETRY_MS / 1000;
    pose.yaw += velocity.angular * seconds;
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    pose.x += (cos * velocity.linear - sin * velocity.lateral) * seconds;
    pose.y += (sin * velocity.linear + cos * velocity.lateral) * seconds;
    if (this.reports && this.#link?.phase === 'live') this.#report();
  }

  #report(): void {
    const none = { x: 0, y: 0, z: 0 };
    const { linear, lateral, angular } = this.velocity;
    const moves = linear !== 0 || lateral !== 0 || angular !== 0;
    this.tell({
      ...{ type: 'telemetry', sequence: ++this.#sequence, timeMs: this.nowMs, pose: this.placed },
      twist: { linear: { ...none, x: linear, y: lateral }, angular: { ...none, z: angular } },
      battery: { percentage: 0.8 },
      drive: this.estop.latched ? 'estop' : moves ? 'driving' : 'idle',
      stages: { captureMs: 1, sampleMs: 1, packMs: 1, sendMs: 1 },
      stream: {
        ...{ frameNumber: 0, framesPerSecond: 10, pointsPerFrame: 0, validPoints: 0 },
        ...{ bitsPerSecond: 0, targetBitsPerSecond: 0, droppedFrames: 0 },
      },
      operators: 1,
      ...this.telemetry,
    });
  }
}
