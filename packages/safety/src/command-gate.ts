import {
  type Command,
  type CommandRejection,
  type DriveLimits,
  isZeroTwist,
  sequenceDelta32,
  type Twist,
} from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';
import type { EstopAnswer } from './estop.ts';
import { QueueingDelay } from './queueing-delay.ts';

export interface RejectedCommand {
  accepted: false;
  reason: CommandRejection;
  /** For people: what is wrong and where, under 200 characters. */
  detail: string;
}

export type CommandVerdict =
  | {
      accepted: true;
      twist: Twist;
      /** So much less than the watchdog's time it is valid, ms: it took longer than usual from the operator's hand. */
      spentMs: number;
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
  /** Whether the robot stands still; undefined: nobody can tell, and it counts as standing. */
  stands?: boolean;
}

export interface CommandGateOptions {
  /** A command that was in transit for longer is stale, ms. */
  maxAgeMs?: number;
  /**
   * If no command was accepted for this long after motion, the hand must let go of the stick before driving again, ms.
   * Default 1000.
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
  /** The drive was handed to it, and it has not shown an open grip since the robot stands. */
  mustOpen: boolean;
}

/**
 * The number of operators whose clock and counter are remembered. Beyond it, the operator that has been silent for
 * longest is forgotten.
 */
const MAX_OPERATORS = 64;
/** Relative tolerance: what a float32 or a decimal round trip may add to a limit. The excess is cut off. */
const TOLERANCE = 1e-6;
/** So much longer than usual any command may take, ms: what was read longer ago is valid for less. */
const JITTER_MS = 30;
/** What a hand may have held through. */
export const WITHOUT_WHEELS = 'the wheels took no velocities';

/**
 * Judges each command of each operator by itself, in this order: rate, lease, sequence, age, emergency stop, dead-man
 * grip, wheels that are away, a drive that was handed over, a grip held through silence, range. Each operator has state of its own: a broken or hostile clock or counter
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
    this.#letGoAfterMs = options.letGoAfterMs ?? 1000;
  }

  check(operatorId: string, command: Command, nowMs: number, context: GateContext): CommandVerdict {
    const operator = this.#operator(operatorId);
    if (!operator.bucket.take(nowMs)) return this.#rateLimited();
    // Refused commands also teach the transit time; otherwise a path that became longer would never be learnt.
    const waitedMs = operator.delay.observe(command.timeMs, nowMs);
    if (!context.holdsLease) return rejected('not-lease-holder', 'the command names no lease that you hold');
    const { lastSequence } = operator;
    if (lastSequence !== null && sequenceDelta32(command.sequence, lastSequence) <= 0) {
      return rejected('repeated', `sequence ${command.sequence} is not after ${lastSequence}`);
    }
    if (!(waitedMs <= this.#maxAgeMs)) {
      return rejected('stale', `${Math.round(waitedMs)} ms late, ${this.#maxAgeMs} ms allowed`);
    }
    // From here on, this command is the operator's latest request. Older ones that arrive after it are ignored, even if
    // this one is refused (because the grip was released, for example).
    operator.lastSequence = command.sequence;
    const motion = !isZeroTwist(command.twist);
    const spentMs = Math.max(0, waitedMs - JITTER_MS);
    if (!motion || !command.deadMan) {
      operator.movedMs = null;
      operator.mustLetGo = null;
    }
    // A stick in its middle is not enough here: the hand may have been on it before it was asked.
    if (!command.deadMan && context.stands !== false) operator.mustOpen = false;
    const estop = context.meetEstop(motion);
    if (motion) {
      const refusal =
        estopRefusal(estop) ??
        (command.deadMan ? null : rejected('dead-man-released', 'motion without the dead-man grip')) ??
        withoutWheels(operator, context.wheelsFault ?? null) ??
        handedOver(operator) ??
        this.#heldThroughSilence(operator, nowMs) ??
        this.#outOfRange(command.twist);
      if (refusal !== null) return refusal;
      operator.movedMs = nowMs - spentMs;
    }
    const { maxLinear, maxAngular } = this.#limits;
    return {
      accepted: true,
      spentMs,
      twist: {
        linear: { x: cutTo(maxLinear, command.twist.linear.x), y: 0, z: 0 },
        angular: { x: 0, y: 0, z: cutTo(maxAngular, command.twist.angular.z) },
      },
    };
  }

  /** Counts an undecodable message against its sender's rate. */
  malformed(operatorId: string, detail: string, nowMs: number): RejectedCommand {
    if (!this.#operator(operatorId).bucket.take(nowMs)) return this.#rateLimited();
    return rejected('malformed', detail.slice(0, 200));
  }

  /**
   * Learns the transit time from another timestamped message: a clock probe, a goal.
   *
   * @returns how much longer than usual it took, ms
   */
  observeClock(operatorId: string, sentMs: number, nowMs: number): number {
    return this.#operator(operatorId).delay.observe(sentMs, nowMs);
  }

  /** Whoever is moving the robot now must let go before it moves again. @param why completes "held while …" */
  requireLetGo(why: string): void {
    for (const operator of this.#operators.values())
      if (operator.movedMs !== null) operator.mustLetGo ??= why;
  }

  /** The drive was handed to this operator: it must show an open grip while the robot stands before it moves anything. */
  requireOpenGrip(operatorId: string): void {
    this.#operator(operatorId).mustOpen = true;
  }

  awaitsOpenGrip(operatorId: string): boolean {
    return this.#operators.get(operatorId)?.mustOpen ?? false;
  }

  /** Whether this operator's hand is still to let go, as {@link requireLetGo} or {@link requireOpenGrip} demanded. */
  awaitsLetGo(operatorId: string): boolean {
    const operator = this.#operators.get(operatorId);
    return operator !== undefined && (operator.mustLetGo !== null || operator.mustOpen);
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
      };
    } else {
      this.#operators.delete(operatorId);
    }
    // Moved to the end of the map: the operator heard from most recently.
    this.#operators.set(operatorId, operator);
    return operator;
  }

  #rateLimited(): RejectedCommand {
    return rejected('rate-limited', `more than ${this.#limits.maxCommandsPerSecond} commands a second`);
  }

  /** A hand that kept holding while the link was down must not move the robot by itself when the link returns. */
  #heldThroughSilence({ movedMs }: OperatorState, nowMs: number): RejectedCommand | null {
    if (movedMs === null || nowMs - movedMs < this.#letGoAfterMs) return null;
    const seconds = ((nowMs - movedMs) / 1000).toFixed(1);
    return rejected('let-go-first', `held while no command came through for ${seconds} s: let go of it once`);
  }

  #outOfRange(twist: Twist): RejectedCommand | null {
    const { maxLinear, maxAngular } = this.#limits;
    const axes: [name: string, value: number, limit: number, unit: string][] = [
      ['linear.x', twist.linear.x, maxLinear, 'm/s'],
      ['linear.y', twist.linear.y, 0, 'm/s'],
      ['linear.z', twist.linear.z, 0, 'm/s'],
      ['angular.x', twist.angular.x, 0, 'rad/s'],
      ['angular.y', twist.angular.y, 0, 'rad/s'],
      ['angular.z', twist.angular.z, maxAngular, 'rad/s'],
    ];
    for (const [name, value, limit, unit] of axes) {
      // Written so that NaN is out of range.
      if (Math.abs(value) <= limit * (1 + TOLERANCE)) continue;
      const shown = Number(value.toPrecision(4));
      return rejected(
        'out-of-range',
        limit === 0
          ? `twist.${name} ${shown} ${unit}: the robot has no such axis`
          : `twist.${name} ${shown} ${unit} is beyond ±${limit} ${unit}`,
      );
    }
    return null;
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

function rejected(reason: CommandRejection, detail: string): RejectedCommand {
  return { accepted: false, reason, detail };
}

/** −limit … limit; never −0. */
function cutTo(limit: number, value: number): number {
  return Math.min(Math.max(value, -limit), limit) + 0;
}
