import type {
  Command,
  EstopCause,
  EstopState,
  LatencyMeasured,
  ProtocolError,
  RobotStop,
} from '@farpoint/protocol';
import type { CommandVerdict, RejectedCommand, RobotStopState } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { LeaseCause, RobotAudit } from '../../admit/audit/robot-audit.ts';
import { LimitedLines } from '../../ground/limited-lines.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { DriveStation } from '../../motion/drive/drive-station.ts';
import type { EstopJournal } from '../../motion/drive/estop-journal.ts';
import { LocalRelease } from '../../motion/drive/local-release.ts';
import type { DriveRecording } from '../../motion/open-drive.ts';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudSensor } from '../../send/clouds/cloud-sensor.ts';
import type { CloudSensors } from '../../send/clouds/cloud-sensors.ts';
import { isUnintended, type PeerEnd } from '../../send/transport/peer-events.ts';
import type { VideoHub } from '../../sense/video/video-hub.ts';
import type { CommandLog } from '../../tell/command-log.ts';
import type { SentFrame, TimedCommand, TraceQueue } from '../../tell/spans/trace-queue.ts';
import type { FrameStations } from '../../tell/stage-board.ts';
import { EstopStory } from './estop-story.ts';
import type { RatedMessage } from './message-rates.ts';
import type { OperatorMessages, SessionHost } from './operator-messages.ts';
import type { OperatorSession } from './operator-session.ts';
import { tellRings, tellVideos } from './welcome.ts';

/** The parts of an operator's session that {@link RobotSessionHost} uses. */
export type HostedOperator = Pick<OperatorSession, 'messages' | 'askLatencyTest' | 'videos'>;

export interface RobotSessionHostParts {
  drive: DriveStation;
  estop: EstopJournal;
  operators: () => ReadonlyMap<string, HostedOperator>;
  sensors: () => Pick<CloudSensors, 'first'>;
  budgets: Pick<Budgets, 'update'>;
  videos: () => Pick<VideoHub, 'descriptions'>;
  counters: RobotCounters;
  recording: DriveRecording | null;
  audit: RobotAudit;
  commandLog: CommandLog | undefined;
  /** Without it, nothing is exported. */
  traces?: TraceQueue | undefined;
  log: Logger;
  now: () => number;
  /** Who drove last has left on purpose. */
  driverLeft: () => void;
}

/** Handles the requests and reports of all sessions on behalf of the robot. */
export class RobotSessionHost implements SessionHost {
  readonly drive: DriveStation;
  readonly #parts: RobotSessionHostParts;
  /** Who holds the lease, or held it last. */
  #driver: string | null = null;
  /** Whoever drives can latch and release the emergency stop without end, but not fill the log. */
  readonly #estopLines = new LimitedLines();
  readonly #localRelease: LocalRelease;
  readonly #estopStory: EstopStory;

  constructor(parts: RobotSessionHostParts) {
    this.drive = parts.drive;
    this.#parts = parts;
    const { latched, by, releasedAt } = parts.drive.guard.estopState();
    // A stop that held the robot and is configured no longer leaves it latched, too.
    const kept = latched && by === 'robot' && releasedAt === undefined ? 'was-latched' : null;
    this.#estopStory = new EstopStory(parts.estop.start.latched?.reason ?? kept);
    this.#localRelease = new LocalRelease(parts.estop.request, parts.drive.guard, parts.log);
  }

  /** Releases the emergency stop once somebody at the robot asks for it. Call this every 25 ms. */
  checkLocalRelease(): void {
    if (!this.#localRelease.look(this.now())) return;
    this.drive.apply();
    this.#keepEstop();
    this.#parts.audit.releasedAtRobot();
    this.#estopStory.changed(false);
    this.#tellEstop();
  }

  now(): number {
    return this.#parts.now();
  }

  /** @param cause if it was not a request */
  leaseChanged(cause?: LeaseCause): void {
    const { audit, operators } = this.#parts;
    const { leaseHolder } = this.drive.guard;
    this.#driver = leaseHolder ?? this.#driver;
    audit.driver(
      leaseHolder,
      leaseHolder === null ? undefined : operators().get(leaseHolder)?.messages,
      cause,
    );
    for (const { messages } of operators().values()) messages.sendLease();
    this.#parts.budgets.update();
  }

  /** Its session has begun, and it has been welcomed. */
  operatorCame(): void {
    this.#latchersChanged();
  }

  /** @param end why its session has ended */
  operatorGone(id: string, end: PeerEnd): void {
    if (id === this.#driver && !isUnintended(end)) this.#parts.driverLeft();
    // Stop the wheels before telling anyone.
    const leaseFreed = this.drive.guard.operatorGone(id);
    this.drive.apply();
    if (leaseFreed) this.leaseChanged('session-ended');
    this.#latchersChanged();
    this.#parts.budgets.update();
  }

  /** Also after the end of its session, when the robot hears that this was meant. */
  driverLeaves({ id }: Pick<OperatorMessages, 'id'>): void {
    if (id === this.#driver) this.#parts.driverLeft();
  }

  estopChanged(by?: OperatorMessages): void {
    const state = this.drive.guard.estopState();
    this.#keepEstop();
    this.#parts.audit.estop(state, by);
    this.#logEstop(state);
    this.#estopStory.changed(state.latched, by?.operatorName);
    this.#tellEstop();
  }

  estopRenewed(by: OperatorMessages): void {
    this.#keepEstop();
    this.#parts.audit.estop(this.drive.guard.estopState(), by);
    this.#estopStory.changed(true, by.operatorName);
    this.#tellEstop();
  }

  /** A stop at the robot itself holds the emergency stop, or no longer. */
  robotStopChanged(stop: RobotStop, said: RobotStopState): void {
    this.drive.apply();
    this.#keepEstop();
    const state = this.drive.guard.estopState();
    this.#parts.audit.robotStop(stop, said, state);
    this.#estopStory.changed(state.latched);
    this.#tellEstop();
  }

  /** Who pressed STOP and who may release it, for this operator; `null` while it is not latched. */
  estopCause(operatorId: string): EstopCause | null {
    const cause = this.drive.guard.estopCause(operatorId);
    return cause === null ? null : { ...cause, ...this.#estopStory.told };
  }

  latencyTestRequested({ id: operator }: OperatorMessages, id: number, commandMs: number): void {
    const isNew = this.#parts.operators().get(operator)?.askLatencyTest({ id, commandMs }) ?? false;
    if (isNew) this.requestLatencyFrame();
  }

  tellVideos(): void {
    for (const operator of this.#parts.operators().values()) tellVideos(operator, this.#parts.videos());
  }

  tellRings(sensor: CloudSensor): void {
    for (const operator of this.#parts.operators().values()) tellRings(operator, sensor);
  }

  requestLatencyFrame(): void {
    this.#parts.sensors().first.capture.requestLatencyTest();
  }

  commandAccepted(): void {
    this.#parts.counters.commandsAccepted++;
  }

  commandRejected(rejection: RejectedCommand): void {
    this.#parts.counters.commandsRejected.add(rejection.reason);
  }

  commandJudged(session: OperatorMessages, command: Command, verdict: CommandVerdict): void {
    if (!verdict.accepted && verdict.reason === 'not-permitted')
      this.#parts.audit.refused('command', verdict.reason, session);
    this.#parts.recording?.command(session.id, command, verdict);
    this.#parts.commandLog?.add(command, verdict.accepted, session.heardMs);
  }

  frameTimed(session: OperatorMessages, frame: SentFrame, at: Readonly<FrameStations>): void {
    this.#parts.traces?.cloud(session, frame, at);
  }

  readonly commandTimed: TimedCommand = (session, sequence, receivedMs, judgedMs, wheelsMs) => {
    this.#parts.traces?.command(session, sequence, receivedMs, judgedMs, wheelsMs);
  };

  latencyMeasured(session: OperatorMessages, measured: LatencyMeasured): void {
    this.#parts.recording?.latencyMeasured(session.id, measured);
  }

  driverName(): string | undefined {
    const { leaseHolder } = this.drive.guard;
    const driver =
      leaseHolder === null ? undefined : this.#parts.operators().get(leaseHolder)?.messages.access;
    return driver?.role == null ? undefined : driver.name;
  }

  refused(session: OperatorMessages, what: 'lease' | 'estop-release', reason: string): void {
    this.#parts.audit.refused(what, reason, session);
  }

  messageRefused(channel: string, error: ProtocolError): void {
    this.#parts.counters.messagesRefused.add(`${channel}:${error.code}`);
    this.#parts.log.debug({ err: error, channel }, 'message refused');
  }

  /** Who comes back may keep others from releasing the emergency stop, and who has left no longer does. */
  #latchersChanged(): void {
    if (this.drive.guard.estopState().latched) this.#tellEstop();
  }

  #tellEstop(): void {
    for (const { messages } of this.#parts.operators().values()) messages.sendEstop();
  }

  #keepEstop(): void {
    const { estopKeptFor, estopHolders } = this.drive.guard;
    this.#parts.estop.changed(estopKeptFor, [...estopHolders]);
  }

  #logEstop(state: EstopState): void {
    const leftOut = this.#estopLines.take(this.now());
    if (leftOut === null) return;
    const unreported = leftOut === 0 ? {} : { unreported: leftOut };
    this.#parts.log.warn({ estop: state, ...unreported }, 'emergency stop changed');
  }

  messageLimited(kind: RatedMessage): void {
    this.#parts.counters.messagesRefused.add(`${kind}:rate-limited`);
  }
}
