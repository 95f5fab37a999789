/** One operator's presses of STOP, which may arrive several times and on two channels, and its releases. */
import {
  type EstopState,
  type FaultReason,
  type RobotSessionMessage,
  sequenceDelta32,
} from '@farpoint/protocol';
import type { EstopReleaseRefusal } from '@farpoint/safety';
import { type Access, mayDrive, supervises } from '../../admit/access/access.ts';
import type { DriveStation } from '../../motion/drive/drive-station.ts';

/**
 * A release that names no latch may have been sent before the operator heard of the present one. It counts
 * only if the operator was told of that at least this long ago, ms. Chosen: above the round trip of any link
 * that can be driven by, and below a person's second try.
 */
const UNNAMED_RELEASE_AFTER_MS = 1000;

type Refusal = Exclude<EstopReleaseRefusal, 'not-latched'> | 'unnamed';

const refusalWords: Record<Refusal, string> = {
  'not-lease-holder': 'only the operator who drives releases the emergency stop',
  'held-at-robot': 'a stop at the robot itself is on: it can be released there only',
  'newer-latch': 'STOP was pressed again in the meantime: the emergency stop stays on',
  unnamed: 'the release names no latch and may have meant an older one: the emergency stop stays on',
  'not-supervisor': 'only a supervisor releases an emergency stop that an operator has pressed',
  'not-latcher': 'only the operator who pressed STOP, or a supervisor, releases the emergency stop',
  'others-latched': 'others have pressed STOP too, and have not released it',
};

/** The operator whose requests they are. */
export interface EstopOperator {
  readonly id: string;
  readonly access: Access;
  /** When a message last came from it, ms on the robot's clock. */
  readonly heardMs: number;
  send(message: RobotSessionMessage): void;
  /** Sends it the state of the emergency stop. */
  sendEstop(): void;
}

/** What the requests change. */
export interface EstopPort {
  readonly drive: DriveStation;
  now(): number;
  /** It was latched or released, and all operators must be told. */
  changed(): void;
  /** It was latched again, and all operators must be told the new number. */
  renewed(): void;
  refused(reason: string): void;
}

export class EstopRequests {
  readonly #operator: EstopOperator;
  readonly #port: EstopPort;
  /** The newest press that has latched. */
  #press: number | null = null;
  /** The latch that the operator was told of last, and when it was first told of it, ms. */
  #told: { latch: number | undefined; atMs: number } | null = null;

  constructor(operator: EstopOperator, port: EstopPort) {
    this.#operator = operator;
    this.#port = port;
  }

  /** The state to be sent to this operator now. */
  told(): EstopState {
    const state = this.#port.drive.guard.estopState();
    if (this.#told?.latch !== state.latch) this.#told = { latch: state.latch, atMs: this.#port.now() };
    return this.#press === null ? state : { ...state, press: this.#press };
  }

  /** @param press left out by operators who do not number their presses: each counts */
  press(press: number | undefined): void {
    if (press !== undefined) {
      // A repeat, or a press that a newer one has overtaken. The stop may have been released since, on purpose.
      if (this.#press !== null && sequenceDelta32(press, this.#press) <= 0) return;
      this.#press = press;
    }
    const { drive } = this.#port;
    const changed = drive.guard.latchEstop('operator', this.#operator.id);
    drive.apply();
    if (changed) this.#port.changed();
    else this.#port.renewed();
  }

  /** @param of number of the latch that is meant */
  release(of: number | undefined): void {
    const { drive } = this.#port;
    const { id, access, heardMs } = this.#operator;
    const supervised = supervises(access);
    const isUnnamed = of === undefined && !this.#knowsPresent(heardMs);
    const mayAsk = supervised || drive.guard.leaseHolder === id;
    if (isUnnamed && mayAsk && drive.guard.estopState().latched) {
      this.#refuse('unnamed');
      return;
    }
    const outcome = drive.guard.releaseEstop(id, supervised, of);
    drive.apply();
    if (outcome.released) this.#port.changed();
    else if (outcome.reason === 'not-latched') this.#operator.sendEstop();
    else this.#refuse(outcome.reason);
  }

  #knowsPresent(nowMs: number): boolean {
    const { latch } = this.#port.drive.guard.estopState();
    return this.#told?.latch === latch && nowMs - (this.#told?.atMs ?? nowMs) >= UNNAMED_RELEASE_AFTER_MS;
  }

  #refuse(reason: Refusal): void {
    this.#port.refused(reason);
    const fault = faultOf(reason, mayDrive(this.#operator.access));
    this.#operator.send({
      type: 'fault',
      message: refusalWords[reason],
      ...(fault === undefined ? {} : { reason: fault }),
    });
    this.#operator.sendEstop();
  }
}

function faultOf(reason: Refusal, drives: boolean): FaultReason | undefined {
  switch (reason) {
    case 'not-lease-holder':
      return drives ? undefined : 'not-permitted';
    case 'held-at-robot':
      return 'held-at-robot';
    case 'not-supervisor':
      return 'not-permitted';
    case 'newer-latch':
    case 'unnamed':
      return 'newer-latch';
    case 'not-latcher':
    case 'others-latched':
      return 'not-latcher';
  }
}
