/** How two peers meet through signaling: offers and answers of one session, in order, with what each side shows. */
import type { OperatorToService } from '@farpoint/protocol';
import {
  type ReceivedOffer,
  SessionAdmission,
  type SessionAdmissionOptions,
  StrangeRobotError,
} from '../access/session-admission.ts';

export interface IntroductionEvents {
  /** An offer that is the robot's. Resolves when it has been answered. */
  onOffer(sdp: string): Promise<void>;
  /** An offer that is not. Nothing of it was used. */
  onStranger(error: StrangeRobotError): void;
  send(message: OperatorToService): void;
}

export class Introduction {
  readonly #admission: SessionAdmission;
  readonly #session: string;
  readonly #events: IntroductionEvents;
  #last: Promise<void> = Promise.resolve();
  #closed = false;

  constructor(options: SessionAdmissionOptions, events: IntroductionEvents) {
    this.#admission = new SessionAdmission(options);
    this.#session = options.session;
    this.#events = events;
  }

  /** Takes an offer from signaling. Offers are checked and answered one after the other. */
  offer(offer: ReceivedOffer): void {
    this.#last = this.#last.then(() => this.#take(offer));
  }

  /** Sends the peer connection's answer. */
  async answer(sdp: string): Promise<void> {
    const shown = await this.#admission.show(sdp);
    if (!this.#closed) this.#events.send({ type: 'session.answer', session: this.#session, sdp, ...shown });
  }

  /** The peer connection is established. */
  connected(): void {
    this.#admission.connected();
  }

  /** Nothing is sent or reported any more. */
  close(): void {
    this.#closed = true;
  }

  async #take(offer: ReceivedOffer): Promise<void> {
    try {
      await this.#admission.check(offer);
      if (!this.#closed) await this.#events.onOffer(offer.sdp);
    } catch (error) {
      if (this.#closed) return;
      const fault =
        error instanceof StrangeRobotError
          ? error
          : new StrangeRobotError('robot-unproven', `its offer cannot be checked: ${String(error)}`);
      this.#events.onStranger(fault);
    }
  }
}
