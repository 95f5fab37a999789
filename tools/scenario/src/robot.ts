import { encodeJson, PROTOCOL_VERSION, stampUsOf, type Twist, telemetryCodec } from '@farpoint/protocol';
import {
  type Access,
  accessWithoutKeys,
  CommandDesk,
  DriveCore,
  monotonicMs,
  OperatorRoster,
  openCommands,
  openObstacleGuard,
  type PeerEnd,
  People,
  RealTimeBase,
  RobotCounters,
  type RobotOptions,
  stands,
  unreadAudit,
  Wheels,
} from '@farpoint/robot-node/testing/drive-core';
import { type Logger, silentLogger } from '@farpoint/service';
import { SimulatedBase, type WorldDescription } from '@farpoint/sim';
import type { Connection } from './connection.ts';
import type { EventLog } from './event-log.ts';
import type { GuardSight } from './guard-sight.ts';
import { RobotSession } from './robot-session.ts';
import type { Signaling } from './signaling.ts';
import { SlowRobot } from './slow-robot.ts';
import { WheelRecord } from './wheel-record.ts';

const [UPDATE_EVERY_MS, BASE_MS, TELEMETRY_MS, CAMERA_MS] = [25, 10, 50, 33];
const ID = 'robot';

export interface RobotParts {
  /** What the robot's program makes of its command line. */
  options: RobotOptions;
  world: WorldDescription;
  signaling: Signaling;
  log: EventLog;
  /** What its guard sees; `null`: it has none. */
  sight: GuardSight | null;
}

/** A robot: all that decides whether it moves, as its program composes it, with simulated wheels and a camera. */
export class ScenarioRobot {
  readonly id = ID;
  readonly core: DriveCore;
  readonly wheels: WheelRecord;
  readonly base: SimulatedBase;
  readonly counters = new RobotCounters();
  readonly sessions = new Map<string, RobotSession>();
  /** How long its camera's clouds take until they leave. */
  readonly slow = new SlowRobot();
  /** Called for each new path that an operator is offered. */
  onRestart: ((session: RobotSession) => void) | null = null;
  readonly #parts: RobotParts;
  readonly #roster = new OperatorRoster();
  readonly #access = accessWithoutKeys(ID, monotonicMs, this.#roster);
  readonly #people: People;
  readonly #commands: CommandDesk;
  readonly #timers: ReturnType<typeof setInterval>[];
  #frameNumber = 0;
  #telemetrySequence = 0;
  #opened = 0;
  #camera = true;

  constructor(parts: RobotParts) {
    const { options, world, log } = parts;
    this.#parts = parts;
    this.base = new SimulatedBase(world, { maxLateralSpeed: options.base?.maxLateral ?? 0 });
    const realTime = new RealTimeBase(this.base);
    const wheels = new Wheels(realTime, options.limits.watchdogMs);
    this.wheels = new WheelRecord(options.limits.watchdogMs, log);
    this.core = this.#openCore(realTime, wheels);
    const { host } = this.core;
    const { sessions: operators, counters } = this;
    this.#people = new People({ operators, roster: this.#roster, host, counters, log: silentLogger() });
    this.#commands = new CommandDesk({
      operators,
      roster: this.#roster,
      drive: host.drive,
      stands: () => stands(this.core.driving),
      now: monotonicMs,
      commands: openCommands(options.commands, null, silentLogger()),
      counters,
      audit: unreadAudit(),
      log: silentLogger(),
    });
    const { motion } = host.drive;
    const report = motion.onIntervention;
    motion.onIntervention = (reason, nowMs) => {
      report?.(reason, nowMs);
      log.add('intervention', { reason });
    };
    this.#timers = [
      setInterval(() => this.#update(), UPDATE_EVERY_MS),
      setInterval(() => this.#advance(realTime, wheels), BASE_MS),
      setInterval(() => this.#tell(realTime), TELEMETRY_MS),
      setInterval(() => this.#capture(), CAMERA_MS),
    ];
  }

  /** Whether the camera's program runs. */
  set camera(runs: boolean) {
    this.#camera = runs;
  }

  /** An operator has asked for a session. @param access by its grant; `null`: the robot asks for none */
  open(name: string, access: Access | null): RobotSession {
    const session = new RobotSession(`session-${++this.#opened}`, name, {
      host: this.core.host,
      connected: (connected) => this.#welcome(connected),
      ended: (ended, end, detail) => this.#ended(ended, end, detail),
    });
    if (access !== null) session.messages.access = access;
    if (access?.subject != null) this.core.host.drive.guard.identify(session.id, access.subject);
    session.messages.onEndSession = (request) =>
      this.#access.endSession(session, request, this.sessions.values());
    session.messages.onCommandRequest = (request) => this.#commands.request(session, request);
    session.messages.onDriveRequest = (request) => this.#people.request(session, request);
    this.sessions.set(session.id, session);
    this.counters.sessionsOpened++;
    return session;
  }

  /** An operator has closed its session, as the service says. */
  closed(id: string): void {
    const session = this.sessions.get(id);
    if (session === undefined) this.core.host.driverLeaves({ id });
    else session.end('closed', 'closed-by-operator');
  }

  /** Its end of a connection. */
  endOf(session: RobotSession): ConstructorParameters<typeof Connection>[2]['robot'] {
    return {
      onConnected: () => session.connected(),
      onMessage: (channel, text) => session.messages.onMessage(channel, text),
      onHeard: () => session.heard(),
      onLost: () => session.end('connection-lost', 'the other side has closed it'),
    };
  }

  close(): void {
    void this.#commands.close();
    for (const timer of this.#timers) clearInterval(timer);
    this.#access.close();
    for (const session of [...this.sessions.values()]) session.end('closed', 'the robot is shutting down');
    this.core.host.drive.close();
  }

  #openCore(base: RealTimeBase, wheels: Wheels): DriveCore {
    const { options, log } = this.#parts;
    const quiet = silentLogger();
    return new DriveCore(options, {
      sink: {
        kind: 'simulated',
        apply: (twist: Twist) => {
          this.wheels.told(twist);
          wheels.apply(twist, monotonicMs());
        },
        close: () => undefined,
      },
      recording: {
        velocity: () => undefined,
        command: (session, command, verdict) => this.wheels.judged(session, command, verdict),
        latencyMeasured: () => undefined,
      },
      audit: unreadAudit(),
      base,
      obstacles: openObstacles(this.#parts, quiet),
      log: quiet,
      counters: this.counters,
      commandLog: undefined,
      now: monotonicMs,
      operators: () => this.sessions,
      alsoHeard: () => null,
      budgets: { update: () => undefined },
      sensors: () => ({ first: undefined as never }),
      videos: () => ({ descriptions: [] }),
      signaling: {
        send: (message) => {
          log.add('signaling', { type: message.type });
          if (message.type === 'session.offer') this.#offer(message.session);
          return true;
        },
        check: () => undefined,
      },
    });
  }

  /** Offers the operator of a session a new path. */
  #offer(id: string): void {
    const session = this.sessions.get(id);
    if (session !== undefined) this.#parts.signaling.post(() => this.onRestart?.(session));
  }

  /** Moves the simulated base to now, and lets the robot's guard see from there. */
  #advance(base: RealTimeBase, wheels: Wheels): void {
    const now = monotonicMs();
    wheels.advance(now);
    this.core.driving.odometry.take({ ...base.state, timeMs: now });
    this.#parts.sight?.look(this.base, now);
  }

  #update(): void {
    this.core.update();
    this.#access.enforce(this.sessions, this.core.host.drive.guard.leaseHolder);
    this.#people.update();
    this.#commands.update();
  }

  #welcome(session: RobotSession): void {
    const { messages, resumeKey } = session;
    const { id, name, limits, afterGap, resumeWithinMs } = this.#parts.options;
    const { role, name: operatorName, expiresAtS } = messages.access;
    const expiresInS = Math.max(0, Math.floor(expiresAtS - Date.now() / 1000));
    messages.send({
      type: 'welcome',
      protocol: PROTOCOL_VERSION,
      ...{ robotId: id, name, limits: { ...limits, afterGap, resumeWithinMs } },
      stream: { format: 'points64', width: 64, height: 64, framesPerSecond: 1000 / CAMERA_MS },
      resumeKey: resumeKey.text,
      ...(role === null ? {} : { access: { role, name: operatorName, expiresInS } }),
    });
    messages.sendLease();
    messages.sendEstop();
    this.#commands.welcome(session);
  }

  #ended(session: RobotSession, end: PeerEnd, detail: string): void {
    this.#parts.log.add('session-ended', { session: session.id, end });
    this.sessions.delete(session.id);
    this.counters.sessionsEnded.add(end);
    this.core.host.operatorGone(session.id, end);
    this.#people.gone(session.id);
    const { signaling } = this.#parts;
    if (end !== 'closed') signaling.post(() => session.onEndTold?.(end, detail));
  }

  #capture(): void {
    if (!this.#camera) return;
    const frame = { number: ++this.#frameNumber, captureUs: stampUsOf(monotonicMs()) };
    this.slow.process(monotonicMs, (stations) => {
      for (const session of this.sessions.values()) session.frame(frame, stations);
    });
  }

  #tell(base: RealTimeBase): void {
    const now = monotonicMs();
    const { status } = this.core.driving;
    const { pose, twist, battery, contact } = base.state;
    const stages = { captureMs: 0, sampleMs: 0, packMs: 0, sendMs: 0 };
    const stream = { frameNumber: this.#frameNumber, framesPerSecond: 30, pointsPerFrame: 0, validPoints: 0 };
    const text = encodeJson(telemetryCodec, {
      type: 'telemetry',
      ...{ sequence: ++this.#telemetrySequence, timeMs: now, pose, twist: twist ?? this.base.state.twist },
      ...(battery === null ? {} : { battery }),
      ...{ drive: status.drive(now, contact), motion: status.state(now), stages },
      stream: { ...stream, bitsPerSecond: 0, targetBitsPerSecond: 0, droppedFrames: 0 },
      operators: this.sessions.size,
    });
    for (const session of this.sessions.values()) {
      if (!session.peer.connected) continue;
      session.telemetry(text);
      const passed = session.messages.stages.due(now, false);
      if (passed !== null) session.telemetry(encodeJson(telemetryCodec, passed));
    }
  }
}

function openObstacles({ options, sight }: RobotParts, log: Logger) {
  return openObstacleGuard(
    {
      configuration: options.obstacleGuard,
      odometry: true,
      captures: [],
      names: ['camera'],
      grids: sight === null ? [] : [{ sensor: 0, reader: sight.reader }],
    },
    true,
    log,
  );
}
