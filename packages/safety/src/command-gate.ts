import {
  type Command,
  type DriveLimits,
  isZeroTwist,
  MOST_RESUME_MS,
  sequenceDelta32,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';
import { cutToLimits, outOfRange, type RejectedCommand, rejected } from './command-range.ts';
import type { EstopAnswer } from './estop.ts';
import { QueueingDelay } from './queueing-delay.ts';

export type { RejectedCommand } from './command-range.ts';

export type CommandVerdict =
  | {
      accepted: true;
      twist: Twist;
      /** So much less than the watchdog's time it is valid, ms: it took longer than usual from the operator's hand. */
      spentMs: number;
      /** The device in the operator's hand was not read: stop, without knowing whether the hand has let go. */
      unread: boolean;
    }
  | RejectedCommand;

/** What the gate must know about the rest of the robot to judge one command. */
export interface GateContext {
  /** Whether the command's operator holds the lease that the command names. */
  holdsLease: boolean;
  /** Called once for each fresh command: returns the emergency stop's answer to this request (estop.ts). */
  meetEstop: (motion: boolean) => EstopAnswer;
  /** Why nothing takes the robot's velocities; `null` or undefined if something does. */
  wheelsFault?: string | null;
  /** Whether the robot stands still, as far as its wheels were told. */
  stands: boolean;
}

export interface CommandGateOptions {
  /** A command that was in transit for longer is stale, ms. */
  maxAgeMs?: number;
  /**
   * If no motion was accepted for this long after motion, and the hand has held on, it must let go of the stick before
   * driving again, ms. Default {@link MOST_RESUME_MS}.
   */
  letGoAfterMs?: number;
  /** How long the shortest transit time is remembered, ms (queueing-delay.ts). */
  delayWindowMs?: number;
}

interface OperatorState {
  bucket: TokenBucket;
  delay: QueueingDelay;
  lastSequence: number | null;
  /** When motion was last accepted; `null` once the hand has let go. */
  movedMs: number | null;
  /** During what the hand held on, and has not let go since; `null` if it has. */
  mustLetGo: string | null;
  /** Whether the drive was handed to it, and it has not shown an open grip since the robot stands. */
  mustOpen: boolean;
  /** Whether the hand is known to be open: the latest that it said was zero, or an open grip. */
  isOpen: boolean;
  /** Of the latest command without the lease. */
  handSequence: number | null;
}

/**
 * The number of operators whose clock and counter are remembered. Beyond it, the operator that has been
 * silent for longest is forgotten. Far more than a robot takes: four, unless configured.
 */
const MAX_OPERATORS = 64;
/**
 * So much longer than usual any command may take, ms: what was read longer ago is valid for less. Chosen:
 * more than a page's timer and a good link vary by, and a fifth of the 150 ms of the watchdog;
 * drive-guard.test.ts holds it.
 */
const JITTER_MS = 30;
/** What a hand may have held through. */
export const WITHOUT_WHEELS = 'the wheels took no velocities';

/**
 * Judges each command of each operator by itself, in this order: rate, lease, sequence, age, emergency stop, dead-man
 * grip, wheels that are away, a drive that was handed over, a grip held
 * through silence, range. Each operator has state of its own: a broken or hostile clock or counter
 * spoils only its own commands.
 */
export class CommandGate {
  readonly #limits: Readonly<DriveLimits>;
  readonly #maxAgeMs: number;
  readonly #delayWindowMs: number;
  readonly #letGoAfterMs: number;
  readonly #operators = new Map<string, OperatorState>();

  constructor(limits: DriveLimits, options: CommandGateOptions = {}) {
    this.#limits = Object.freeze({ ...limits });
    this.#maxAgeMs = options.maxAgeMs ?? limits.watchdogMs;
    this.#delayWindowMs = options.delayWindowMs ?? 10_000;
    this.#letGoAfterMs = options.letGoAfterMs ?? MOST_RESUME_MS;
  }

  check(operatorId: string, command: Command, nowMs: number, context: GateContext): CommandVerdict {
    const operator = this.#operator(operatorId);
    if (!operator.bucket.take(nowMs)) return this.#rateLimited();
    // Refused commands also teach the transit time; otherwise a path that became longer would never be learnt.
    const waitedMs = operator.delay.observe(command.timeMs, nowMs);
    const { lastSequence } = operator;
    const motion = !isZeroTwist(command.twist);
    const isNeutral = command.unread !== true && (!motion || !command.deadMan);
    if (!context.holdsLease) {
      this.#noteHand(operator, command.sequence, isNeutral, waitedMs);
      return rejected('not-lease-holder', 'the command names no lease that you hold');
    }
    if (lastSequence !== null && sequenceDelta32(command.sequence, lastSequence) <= 0) {
      return rejected('repeated', `sequence ${command.sequence} is not after ${lastSequence}`);
    }
    if (!(waitedMs <= this.#maxAgeMs)) {
      return rejected('stale', `${Math.round(waitedMs)} ms late, ${this.#maxAgeMs} ms allowed`);
    }
    // From here on, this command is the operator's latest request. Older ones that arrive after it are ignored, even if
    // this one is refused (because the grip was released, for example).
    operator.lastSequence = command.sequence;
    const spentMs = Math.max(0, waitedMs - JITTER_MS);
    if (command.unread === true) return { accepted: true, spentMs, unread: true, twist: zeroTwist() };
    operator.isOpen = isNeutral;
    if (isNeutral) {
      operator.movedMs = null;
      operator.mustLetGo = null;
    }
    // A stick in its middle is not enough here: the hand may have been on it before it was asked.
    if (!command.deadMan && context.stands) operator.mustOpen = false;
    const estop = context.meetEstop(!isNeutral);
    if (motion) {
      const refusal =
        estopRefusal(estop) ??
        (command.deadMan ? null : rejected('dead-man-released', 'motion without the dead-man grip')) ??
        withoutWheels(operator, context.wheelsFault ?? null) ??
        handedOver(operator) ??
        this.#heldThroughSilence(operator, nowMs) ??
        outOfRange(command.twist, this.#limits);
      if (refusal !== null) return refusal;
      operator.movedMs = nowMs - spentMs;
    }
    return { accepted: true, spentMs, unread: false, twist: cutToLimits(command.twist, this.#limits) };
  }

  /** Counts an undecodable message against its sender's rate. */
  malformed(operatorId: string, detail: string, nowMs: number): RejectedCommand {
    if (!this.#operator(operatorId).bucket.take(nowMs)) return this.#rateLimited();
    return rejected('malformed', detail.slice(0, 200));
  }

  /**
   * Learns the transit time from another timestamped message.
   *
   * @returns how much longer than usual it was under way, ms
   */
  observeClock(operatorId: string, sentMs: number, nowMs: number): number {
    return this.#operator(operatorId).delay.observe(sentMs, nowMs);
  }

  /**
   * The operator drives from now on. A hand that is not known to be open must let go first: it may have held on since
   * another robot, session or driver.
   */
  takesOver(operatorId: string): void {
    const operator = this.#operator(operatorId);
    // What an earlier hand-over demanded went with the lease that it gave.
    operator.mustOpen = false;
    if (!operator.isOpen) operator.mustLetGo ??= 'you did not drive';
  }

  /** The drive was handed to this operator: it must show an open grip while the robot stands before it moves anything. */
  requireOpenGrip(operatorId: string): void {
    this.#operator(operatorId).mustOpen = true;
  }

  /** The operator's grip has closed, but it may not drive: it must open before it does. */
  asksInVain(operatorId: string): void {
    this.#operator(operatorId).isOpen = false;
  }

  /** The operator's hand is open, by what its protocol says without a command. */
  opens(operatorId: string): void {
    const operator = this.#operator(operatorId);
    operator.isOpen = true;
    operator.movedMs = null;
    operator.mustLetGo = null;
  }

  /** Whoever is moving the robot now must let go before it moves again. @param why completes "held while …" */
  requireLetGo(why: string): void {
    for (const operator of this.#operators.values())
      if (operator.movedMs !== null) operator.mustLetGo ??= why;
  }

  /** Whether motion of this operator would be refused until its hand has let go, whoever or whatever demands that. */
  mustLetGo(operatorId: string, nowMs: number): boolean {
    const operator = this.#operators.get(operatorId);
    if (operator === undefined) return false;
    return operator.mustOpen || operator.mustLetGo !== null || this.#heldTooLong(operator, nowMs);
  }

  /** Whether this operator's hand is still to let go, as {@link requireLetGo} or {@link requireOpenGrip} demanded. */
  awaitsLetGo(operatorId: string): boolean {
    const operator = this.#operators.get(operatorId);
    return operator !== undefined && (operator.mustOpen || operator.mustLetGo !== null);
  }

  forget(operatorId: string): void {
    this.#operators.delete(operatorId);
  }

  #operator(operatorId: string): OperatorState {
    let operator = this.#operators.get(operatorId);
    if (operator === undefined) {
      if (this.#operators.size >= MAX_OPERATORS) {
        this.#operators.delete(this.#operators.keys().next().value as string);
      }
      operator = {
        bucket: new TokenBucket({ perSecond: this.#limits.maxCommandsPerSecond }),
        delay: new QueueingDelay(this.#delayWindowMs),
        lastSequence: null,
        movedMs: null,
        mustLetGo: null,
        mustOpen: false,
        isOpen: false,
        handSequence: null,
      };
    } else {
      this.#operators.delete(operatorId);
    }
    // Moved to the end of the map: the operator heard from most recently.
    this.#operators.set(operatorId, operator);
    return operator;
  }

  /** What the hand of one who does not drive says of itself. */
  #noteHand(operator: OperatorState, sequence: number, isNeutral: boolean, waitedMs: number): void {
    for (const last of [operator.lastSequence, operator.handSequence])
      if (last !== null && sequenceDelta32(sequence, last) <= 0) return;
    if (!(waitedMs <= this.#maxAgeMs)) return;
    operator.handSequence = sequence;
    operator.isOpen = isNeutral;
  }

  #rateLimited(): RejectedCommand {
    return rejected('rate-limited', `more than ${this.#limits.maxCommandsPerSecond} commands a second`);
  }

  /** A hand that kept holding while the link was down must not move the robot by itself when the link returns. */
  #heldThroughSilence(operator: OperatorState, nowMs: number): RejectedCommand | null {
    const { movedMs } = operator;
    if (movedMs === null || !this.#heldTooLong(operator, nowMs)) return null;
    const seconds = ((nowMs - movedMs) / 1000).toFixed(1);
    return rejected('let-go-first', `held while no command came through for ${seconds} s: let go of it once`);
  }

  #heldTooLong({ movedMs }: OperatorState, nowMs: number): boolean {
    return movedMs !== null && !(nowMs - movedMs < this.#letGoAfterMs);
  }
}

function estopRefusal(estop: EstopAnswer): RejectedCommand | null {
  if (estop === 'clear') return null;
  return rejected(
    'estop-latched',
    estop === 'latched'
      ? 'the emergency stop is latched'
      : 'the emergency stop was released with the stick held: let go of it once',
  );
}

/** A hand that kept holding while the wheels were away must not move them by itself when they return. */
function withoutWheels(operator: OperatorState, fault: string | null): RejectedCommand | null {
  if (fault !== null) {
    operator.mustLetGo = WITHOUT_WHEELS;
    return rejected('no-wheels', fault.slice(0, 199));
  }
  if (operator.mustLetGo === null) return null;
  return rejected('let-go-first', `held while ${operator.mustLetGo}: let go of it once`);
}

/** A hand that was on the grip when the drive came to it must not move the robot. */
function handedOver({ mustOpen }: OperatorState): RejectedCommand | null {
  if (!mustOpen) return null;
  return rejected('let-go-first', 'the drive was handed over: open the grip once while the robot stands');
}
