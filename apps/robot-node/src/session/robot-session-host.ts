import type {
  Command,
  CommandAnswer,
  EstopCause,
  EstopState,
  GoalPhase,
  GoalReason,
  GoalRequest,
  LatencyMeasured,
  ProtocolError,
  RobotAbout,
} from '@farpoint/protocol';
import type { CommandVerdict, Goal, RejectedCommand, RobotStop, RobotStopState } from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { LeaseCause, RobotAudit } from '../audit/robot-audit.ts';
import type { DriveStation } from '../drive/drive-station.ts';
import type { EstopJournal } from '../drive/estop-journal.ts';
import type { GoalStation } from '../goals/goal-station.ts';
import type { CommandStation } from '../robot-commands/command-station.ts';
import type { RobotOptions } from '../robot-configuration.ts';
import type { CloudSensor } from '../sensors/cloud-sensor.ts';
import type { CloudSensors } from '../sensors/cloud-sensors.ts';
import type { CommandLog } from '../telemetry/command-log.ts';
import { LimitedLines } from '../telemetry/limited-lines.ts';
import type { RobotCounters } from '../telemetry/robot-counters.ts';
import type { SessionRecording } from '../telemetry/session-recording.ts';
import type { VideoHub } from '../video/video-hub.ts';
import { EstopStory } from './estop-story.ts';
import type { RatedMessage } from './message-rates.ts';
import type { OperatorSession } from './operator-session.ts';
import { robotAbout } from './robot-about.ts';
import type { SessionHost, SessionOperator } from './session-host.ts';
import { tellRings, tellVideos } from './welcome.ts';

export interface RobotSessionHostParts {
  drive: DriveStation;
  estop: EstopJournal;
  /** `null` if the robot takes no goals. */
  goals: GoalStation | null;
  /** `null` if the robot takes no commands. */
  commands: CommandStation | null;
  operators: () => ReadonlyMap<string, OperatorSession>;
  options: Pick<RobotOptions, 'sink' | 'base' | 'sensors'>;
  sensors: () => CloudSensors;
  videos: () => VideoHub;
  counters: RobotCounters;
  recording: SessionRecording | null;
  audit: RobotAudit;
  commandLog: CommandLog | undefined;
  log: Logger;
  now: () => number;
}

/** Handles the requests and reports of all sessions on behalf of the robot. */
export class RobotSessionHost implements SessionHost {
  readonly drive: DriveStation;
  readonly #parts: RobotSessionHostParts;
  /** Whoever drives can latch and release the emergency stop without end, but not fill the log. */
  readonly #estopLines = new LimitedLines();
  readonly #commandLines = new LimitedLines();

  readonly #estopStory: EstopStory;

  constructor(parts: RobotSessionHostParts) {
    this.drive = parts.drive;
    this.#parts = parts;
    const { latched, by, releasedAt } = parts.drive.guard.estopState();
    // A stop that held the robot and is configured no longer leaves it latched, too.
    const kept = latched && by === 'robot' && releasedAt === undefined ? 'was-latched' : null;
    this.#estopStory = new EstopStory(parts.estop.start.latched?.reason ?? kept);
    if (parts.recording !== null)
      parts.recording.onChanged = () => {
        for (const { messages } of parts.operators().values()) messages.send(this.about);
      };
    if (parts.goals !== null)
      parts.goals.onState = (goal, state, reason) => this.#goalChanged(goal, state, reason);
  }

  now(): number {
    return this.#parts.now();
  }

  /** What each operator is told after the welcome. */
  get about(): RobotAbout {
    return robotAbout(this.#parts.options, this.#parts.recording?.writes ?? false);
  }

  /** @param cause if it was not a request */
  leaseChanged(cause?: LeaseCause): void {
    const { audit, operators } = this.#parts;
    const { leaseHolder } = this.drive.guard;
    audit.driver(
      leaseHolder,
      leaseHolder === null ? undefined : operators().get(leaseHolder)?.messages,
      cause,
    );
    for (const { messages } of operators().values()) messages.sendLease();
    this.#parts.sensors().updateBudgets();
  }

  operatorGone(id: string): void {
    // Stop the wheels before telling anyone.
    const leaseFreed = this.drive.guard.operatorGone(id);
    this.drive.apply();
    if (leaseFreed) this.leaseChanged('session-ended');
    // Whoever has left no longer keeps others from releasing it.
    if (this.drive.guard.estopState().latched) this.#tellEstop();
    this.#parts.sensors().updateBudgets();
  }

  estopChanged(by?: SessionOperator): void {
    const { audit } = this.#parts;
    const state = this.drive.guard.estopState();
    this.#keepEstop();
    audit.estop(state, by);
    this.#logEstop(state);
    this.#estopStory.changed(state.latched, by?.operatorName);
    this.#tellEstop();
  }

  estopRenewed(by: SessionOperator): void {
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

  latencyTestRequested({ id: operator }: SessionOperator, id: number, commandMs: number): void {
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

  commandJudged(session: SessionOperator, command: Command, verdict: CommandVerdict): void {
    if (!verdict.accepted && verdict.reason === 'not-permitted')
      this.#parts.audit.refused('command', verdict.reason, session);
    this.#parts.recording?.command(session.id, command, verdict);
    this.#parts.commandLog?.add(command, verdict.accepted, session.heardMs);
  }

  latencyMeasured(session: SessionOperator, measured: LatencyMeasured): void {
    this.#parts.recording?.latencyMeasured(session.id, measured);
  }

  driverName(): string | undefined {
    const { leaseHolder } = this.drive.guard;
    const driver =
      leaseHolder === null ? undefined : this.#parts.operators().get(leaseHolder)?.messages.access;
    return driver?.role == null ? undefined : driver.name;
  }

  refused(session: SessionOperator, what: 'lease' | 'estop-release', reason: string): void {
    this.#parts.audit.refused(what, reason, session);
  }

  goalRefused(session: SessionOperator, goal: GoalRequest, reason: GoalReason): void {
    this.#parts.goals?.refused.add(reason);
    this.#parts.audit.goal(goal, 'refused', reason, session);
  }

  get commands(): CommandStation | null {
    return this.#parts.commands;
  }

  commandAnswered(session: SessionOperator, id: string, answer: CommandAnswer): void {
    const { commands, audit, log } = this.#parts;
    const { outcome, reason, detail } = answer;
    commands?.outcomes.add(reason ?? outcome);
    audit.robotCommand(id, answer, session);
    const leftOut = this.#commandLines.take(this.now());
    if (leftOut === null) return;
    const { operatorName: operator } = session;
    const unreported = leftOut === 0 ? undefined : leftOut;
    log.info({ command: id, operator, outcome, reason, detail, unreported }, 'robot command');
  }

  messageRefused(channel: string, error: ProtocolError): void {
    this.#parts.counters.messagesRefused.add(`${channel}:${error.code}`);
    this.#parts.log.debug({ err: error, channel }, 'message refused');
  }

  #goalChanged(goal: Readonly<Goal>, state: GoalPhase, reason: GoalReason | null): void {
    const { audit, operators } = this.#parts;
    const operator = operators().get(goal.operatorId)?.messages;
    if (state !== 'driving') audit.goal(goal, state, reason, operator);
    operator?.send({ type: 'goalState', id: goal.id, state, ...(reason === null ? {} : { reason }) });
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
