/** Remembers that another operator has taken over from this one, for as long as this one's hand holds on. */
import { givesYou, type Handover, type RobotClient } from '@farpoint/operator';
import type { LeaseState } from '@farpoint/protocol';

export class Takeover {
  #held = false;
  #by: string | null = null;
  /** Who drives since a request or an offer is open: whether that was agreed, its end says. */
  #perhaps: string | null = null;
  /** Whether this operator has handed the drive over, and its hand holds on. */
  #handedOver = false;

  /**
   * Takes what the robot says from now on.
   *
   * @param told is called when another has taken over, with its name, by its grant
   */
  follow(client: Pick<RobotClient, 'on' | 'link'>, told?: (driver: string | null) => void): void {
    const isOpen = () =>
      client.link.session.people
        .open(performance.now())
        .some(({ kind, yours }) => (kind === 'offer') === yours);
    client.on('session', () => this.reset());
    client.on('lease', ({ holder, driver = null }) => {
      if (this.onLease(holder, driver, isOpen())) told?.(driver);
    });
    client.on('handover', (handover) => {
      if (this.onHandover(handover, isOpen())) told?.(this.#by || null);
    });
  }

  /**
   * The robot has told who drives.
   *
   * @param driver its name, by its grant
   * @param isOpen whether this operator may just have agreed to it: an offer of its own or a request to it is open
   * @returns whether another has just taken over from this operator
   */
  onLease(holder: LeaseState['holder'], driver: string | null, isOpen = false): boolean {
    const taken = this.#held && holder === 'other';
    this.#held = holder === 'you';
    if (holder !== 'other') this.#forget();
    if (!taken) return false;
    if (isOpen) this.#perhaps = driver ?? '';
    else this.#by = driver ?? '';
    return !isOpen;
  }

  /**
   * A request or an offer was made, or has ended.
   *
   * @param isOpen whether there are others that this operator may have agreed to
   * @returns whether it is certain now that another has taken over from this operator
   */
  onHandover(handover: Handover, isOpen: boolean): boolean {
    if (this.#perhaps === null || handover.ended === undefined) return false;
    const isAgreed = handover.ended === 'accepted' && !givesYou(handover);
    if (!isAgreed && isOpen) return false;
    this.#by = isAgreed ? null : this.#perhaps;
    this.#perhaps = null;
    this.#handedOver = isAgreed;
    return !isAgreed;
  }

  /** A session begins or ends. */
  reset(): void {
    this.#held = false;
    this.#forget();
  }

  #forget(): void {
    this.#by = null;
    this.#perhaps = null;
    this.#handedOver = false;
  }

  /** Who took over from a hand that still holds on, '' without a name; `null`: nobody did. @param gripped whether it does */
  by(gripped: boolean): string | null {
    if (!gripped) this.#by = null;
    return this.#by;
  }

  /** Whether a hand still holds on that another has taken the drive from, or that has handed it over. */
  isDisplaced(gripped: boolean): boolean {
    if (!gripped) this.#handedOver = false;
    return this.by(gripped) !== null || this.#perhaps !== null || this.#handedOver;
  }
}
