/** Interprets one operator's messages and sends the answers. */
import {
  type Command,
  type CommandCall,
  type CommandCancel,
  clockAnswerCodec,
  type DriveRequest,
  decodeBandwidth,
  decodeJson,
  decodeStreamSwitch,
  type EndSession,
  type EstopCause,
  encodeJson,
  type LatencyMeasured,
  type OperatorSessionMessage,
  operatorControlCodec,
  operatorSessionCodec,
  type Point,
  ProtocolError,
  type ReceiverReport,
  type RobotSessionMessage,
  robotControlCodec,
  robotSessionCodec,
  sequenceDelta32,
} from '@farpoint/protocol';
import type { CommandVerdict, RejectedCommand } from '@farpoint/safety';
import { type Access, mayDrive, openAccess, supervises } from '../../admit/access/access.ts';
import type { DriveStation } from '../../motion/drive/drive-station.ts';
import type { SentFrame, TimedCommand } from '../../tell/spans/trace-queue.ts';
import { type FrameStations, StageBoard } from '../../tell/stage-board.ts';
import { CommandPipeline, NOT_PERMITTED } from './command-pipeline.ts';
import { EstopRequests } from './estop-requests.ts';
import { MessageRates, type RatedMessage } from './message-rates.ts';
import { OperatorWishes } from './operator-wishes.ts';

/** Sends a session's messages to its operator. */
export interface SessionLink {
  sendSession(text: string): void;
  sendControl(text: string): void;
}

/** What a session needs from the robot. */
export interface SessionHost {
  readonly drive: DriveStation;
  now(): number;
  /** The driver has changed, and all operators must be told. @param cause if it was not a request */
  leaseChanged(cause?: 'expired' | 'session-ended' | 'handed-over'): void;
  /** It has given the lease back, or would if it still had it. */
  driverLeaves?(session: OperatorMessages): void;
  /** The emergency stop was latched or released. @param by who changed it; undefined: the robot itself */
  estopChanged(by?: OperatorMessages): void;
  /** It was latched again: all operators must be told its new number. */
  estopRenewed(by: OperatorMessages): void;
  latencyTestRequested(session: OperatorMessages, id: number, commandMs: number): void;
  /** For the counters. */
  commandAccepted(): void;
  commandRejected(rejection: RejectedCommand): void;
  /** For a recording: each command, and the guard's verdict. */
  commandJudged?(session: OperatorMessages, command: Command, verdict: CommandVerdict): void;
  /** For its spans: when a frame that was sent to an operator passed the robot's stations. */
  frameTimed?(session: OperatorMessages, frame: SentFrame, at: Readonly<FrameStations>): void;
  /** For its spans: when a command did. */
  readonly commandTimed?: TimedCommand | undefined;
  /** For a recording: what an operator measured. */
  latencyMeasured?(session: OperatorMessages, measured: LatencyMeasured): void;
  /** For the audit log: a request that was refused. */
  refused?(session: OperatorMessages, what: 'lease' | 'estop-release', reason: string): void;
  messageRefused(channel: string, error: ProtocolError): void;
  /** A message was dropped because there were too many of its kind. */
  messageLimited?(kind: RatedMessage): void;
  /** The driver's name by its grant; undefined if nobody drives or there are no grants. */
  driverName?(): string | undefined;
  /** Who pressed STOP and who may release it, for this operator; `null` while it is not latched. */
  estopCause?(operatorId: string): EstopCause | null;
}

export class OperatorMessages {
  readonly id: string;
  /** What the operator may do. */
  access: Access;
  /** What it wants of the robot's streams. */
  readonly wishes = new OperatorWishes();
  /** When its frames and commands passed the robot's stations. */
  readonly stages = new StageBoard();
  /** When a message last came from the operator on any channel, ms on the robot's clock. */
  heardMs: number;
  onReceiverReport: ((report: ReceiverReport) => void) | null = null;
  onReceiverLimit: ((bitsPerSecond: number) => void) | null = null;
  /** Of supervisors only. */
  onEndSession: ((request: EndSession) => void) | null = null;
  /** What it asks of the other operators. */
  onDriveRequest: ((request: DriveRequest) => void) | null = null;
  /** Which of the robot's commands it gives or cancels. */
  onCommandRequest: ((request: CommandCall | CommandCancel) => void) | null = null;
  /** The spot at which it points, for the others. */
  onPoint: ((point: Point) => void) | null = null;
  readonly #host: SessionHost;
  readonly #link: SessionLink;
  readonly #commands: CommandPipeline;
  readonly #estop: EstopRequests;
  readonly #rates = new MessageRates((kind, tell) => {
    this.#host.messageLimited?.(kind);
    if (tell) this.send({ type: 'fault', message: `too many ${kind} messages: some were dropped` });
  });
  #lastReport: number | null = null;

  constructor(id: string, operatorName: string, host: SessionHost, link: SessionLink) {
    this.id = id;
    this.access = openAccess(operatorName);
    this.#host = host;
    this.#link = link;
    this.heardMs = host.now();
    this.#commands = new CommandPipeline(id, {
      drive: host.drive,
      now: () => host.now(),
      mayDrive: () => mayDrive(this.access),
      judged: (command, verdict) => host.commandJudged?.(this, command, verdict),
      accepted: () => host.commandAccepted(),
      timed: (sequence, receivedMs, judgedMs, wheelsMs) => {
        this.stages.command(sequence, receivedMs, judgedMs, wheelsMs);
        host.commandTimed?.(this, sequence, receivedMs, judgedMs, wheelsMs);
      },
      rejected: (verdict) => host.commandRejected(verdict),
      latencyTestRequested: (test, commandMs) => host.latencyTestRequested(this, test, commandMs),
      report: (rejected) => this.send(rejected),
    });
    this.#estop = new EstopRequests(this, {
      drive: host.drive,
      now: () => host.now(),
      changed: () => host.estopChanged(this),
      renewed: () => host.estopRenewed(this),
      refused: (reason) => host.refused?.(this, 'estop-release', reason),
    });
  }

  /** Tells the operator the state of the drive lease; sent after the welcome and at each change. */
  sendLease(): void {
    const driver = this.#host.driverName?.();
    const named = driver === undefined ? {} : { driver };
    this.send({ ...this.#host.drive.guard.leaseState(this.id), ...named });
  }

  get operatorName(): string {
    return this.access.name;
  }

  /** Tells the operator the state of the emergency stop, and before it what explains it. */
  sendEstop(): void {
    const cause = this.#host.estopCause?.(this.id) ?? null;
    if (cause !== null) this.send(cause);
    this.send(this.#estop.told());
  }

  send(message: RobotSessionMessage): void {
    this.#link.sendSession(encodeJson(robotSessionCodec, message));
  }

  /** Sends rejection reports that were held back to limit their rate. Call a few times a second. */
  flushRejections(): void {
    this.#commands.flushRejections();
  }

  onMessage(channel: 'session' | 'control' | 'bandwidth', data: string | Uint8Array): void {
    this.heardMs = this.#host.now();
    if (this.#rates.drops(channel, data, this.heardMs)) return;
    try {
      if (channel === 'control') this.#onControl(data);
      else if (channel === 'session') this.#onSession(data);
      else this.#onBandwidth(data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.#host.messageRefused(channel, error);
      if (channel === 'control') this.#commands.onMalformed(error, this.heardMs);
      else this.send({ type: 'fault', message: error.message.slice(0, 512) });
    }
  }

  #onBandwidth(data: string | Uint8Array): void {
    if (typeof data === 'string')
      throw new ProtocolError('invalid', 'bandwidth message', '', 'text, not bytes');
    this.onReceiverLimit?.(decodeBandwidth(data));
  }

  #onControl(data: string | Uint8Array): void {
    const now = this.heardMs;
    const message = decodeJson(operatorControlCodec, data);
    switch (message.type) {
      case 'command':
        this.#commands.onCommand(message, now);
        break;
      case 'clockProbe': {
        if (this.#rates.over('probe', now)) break;
        const { id, sentMs } = message;
        this.#link.sendControl(
          encodeJson(clockAnswerCodec, { type: 'clockAnswer', id, sentMs, robotMs: this.#host.now() }),
        );
        this.#host.drive.guard.onClockProbe(this.id, sentMs, now);
        break;
      }
      case 'receiverReport':
        // Reports may overtake each other. One older than the latest says nothing new.
        if (this.#lastReport !== null && sequenceDelta32(message.sequence, this.#lastReport) <= 0) break;
        this.#lastReport = message.sequence;
        this.onReceiverReport?.(message);
        break;
      case 'estop':
        this.#estop.press(message.press);
        this.#link.sendControl(encodeJson(robotControlCodec, { type: 'estopAck', press: message.press }));
        break;
    }
  }

  #onSession(data: string | Uint8Array): void {
    // The reference system's operators switch the stream with plain words, not JSON.
    if (typeof data === 'string' && !data.startsWith('{')) {
      this.wishes.switchStream(decodeStreamSwitch(data) === 'start');
      return;
    }
    this.#onRequest(decodeJson(operatorSessionCodec, data));
  }

  #onRequest(message: OperatorSessionMessage): void {
    const { drive } = this.#host;
    switch (message.type) {
      case 'leaseRequest':
        this.#requestLease(message.take);
        break;
      case 'leaseRelease': {
        const released = drive.guard.releaseLease(this.id);
        drive.apply();
        this.#host.driverLeaves?.(this);
        if (released) this.#host.leaseChanged();
        else this.sendLease();
        break;
      }
      case 'driveAsk':
      case 'driveOffer':
      case 'driveAnswer':
      case 'driveWithdraw':
        this.onDriveRequest?.(message);
        break;
      case 'callCommand':
      case 'cancelCommand':
        this.onCommandRequest?.(message);
        break;
      case 'point':
        if (!this.#rates.over('point', this.heardMs)) this.onPoint?.(message);
        break;
      case 'estop':
        if (message.latch) this.#estop.press(message.press);
        else this.#estop.release(message.of);
        break;
      case 'endSession':
        if (supervises(this.access)) this.onEndSession?.(message);
        else this.#notPermitted('only a supervisor ends the sessions of others');
        break;
      case 'latencyMeasured':
        this.#host.latencyMeasured?.(this, message);
        break;
      default:
        this.wishes.take(message, mayDrive(this.access));
    }
  }

  /** @param take whether to take it from another operator */
  #requestLease(take: boolean): void {
    if (this.#rates.over('lease', this.heardMs)) return;
    if (!mayDrive(this.access)) {
      this.#host.refused?.(this, 'lease', 'not-permitted');
      this.#notPermitted(NOT_PERMITTED.detail);
      this.sendLease();
      return;
    }
    const { drive } = this.#host;
    const outcome = drive.guard.requestLease(this.id, take, this.heardMs, supervises(this.access));
    drive.apply();
    if (outcome.granted) {
      this.#host.leaseChanged();
      return;
    }
    this.#host.refused?.(this, 'lease', outcome.reason);
    this.send({ type: 'fault', message: outcome.detail });
    this.sendLease();
  }

  #notPermitted(message: string): void {
    this.send({ type: 'fault', message, reason: 'not-permitted' });
  }
}
