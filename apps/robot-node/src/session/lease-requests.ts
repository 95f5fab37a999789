/** One operator's requests for the lease: who may drive, how often it may ask, and what it is told. */
import type { RobotSessionMessage } from '@farpoint/protocol';
import { type Access, mayDrive, supervises } from '../access/access.ts';
import type { DriveStation } from '../drive/drive-station.ts';
import type { MessageRates } from './message-rates.ts';

/** The operator whose requests they are. */
export interface LeaseOperator {
  readonly id: string;
  readonly access: Access;
  /** When a message last came from it, ms on the robot's clock. */
  readonly heardMs: number;
  send(message: RobotSessionMessage): void;
  /** Sends it the state of the lease. */
  sendLease(): void;
}

export interface LeasePort {
  readonly drive: DriveStation;
  readonly rates: MessageRates;
  /** Whoever drives has changed, and all operators must be told. */
  changed(): void;
  refused(reason: string): void;
}

export class LeaseRequests {
  readonly #operator: LeaseOperator;
  readonly #port: LeasePort;

  constructor(operator: LeaseOperator, port: LeasePort) {
    this.#operator = operator;
    this.#port = port;
  }

  /** @param take whether to take it from another operator */
  request(take: boolean): void {
    const { id, access, heardMs } = this.#operator;
    const { drive, rates, changed, refused } = this.#port;
    if (rates.over('lease', heardMs)) return;
    if (!mayDrive(access)) {
      refused('not-permitted');
      const message = 'your grant lets you watch this robot, not drive it';
      this.#operator.send({ type: 'fault', message, reason: 'not-permitted' });
      this.#operator.sendLease();
      return;
    }
    const outcome = drive.guard.requestLease(id, take, heardMs, supervises(access));
    drive.apply();
    if (outcome.granted) {
      changed();
      return;
    }
    refused(outcome.reason);
    this.#operator.send({ type: 'fault', message: outcome.detail });
    this.#operator.sendLease();
  }

  release(): void {
    const { drive, changed } = this.#port;
    const released = drive.guard.releaseLease(this.#operator.id);
    drive.apply();
    if (released) changed();
    else this.#operator.sendLease();
  }
}
