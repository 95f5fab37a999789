/** Decides which offers of a robot to answer, from what signaling tells a client. Pure. */
import type { ReferenceRobot, ReferenceServiceToClient } from '@farpoint/protocol';

export interface OpenOffer {
  robotId: number;
  sdpOffer: string;
  candidates: readonly string[];
}

/** As many as a sentence names. */
const MAX_OTHERS = 8;

export class OfferBoard {
  readonly #name: string;
  /** Robots with that name, whether or not their offer was answered. */
  readonly #ids = new Set<number>();
  /** Of robots with other names. */
  readonly others = new Set<string>();
  /** The service has answered with a list of robots. */
  listed = false;

  constructor(name: string) {
    this.#name = name;
  }

  /** Whether a robot with that name has registered. */
  get knows(): boolean {
    return this.#ids.size > 0;
  }

  /** The offers to answer because of this message. */
  read(message: ReferenceServiceToClient): OpenOffer[] {
    switch (message.type) {
      case 'robots':
        this.listed = true;
        return this.#fromList(message.robots);
      case 'register':
        return this.#isOurs(message.robot) ? [toOffer(message.robot)] : [];
      case 'offer':
        // The reference system's robot sends such an offer about 6 s after its operator has left.
        return this.#ids.has(message.robotId)
          ? [{ robotId: message.robotId, sdpOffer: message.sdpOffer, candidates: [] }]
          : [];
      default:
        return [];
    }
  }

  /**
   * The list may contain registrations that have ended: the reference signaling keeps some, and their robot would take
   * an answer to such an offer for one to its newer offer. An offer without an answer is open; if each has one, the
   * last may still be open.
   */
  #fromList(robots: readonly ReferenceRobot[]): OpenOffer[] {
    const ours = robots.filter((robot) => this.#isOurs(robot));
    const open = ours.filter(({ sdpAnswer }) => sdpAnswer === null);
    return (open.length > 0 ? open : ours.slice(-1)).map(toOffer);
  }

  #isOurs({ id, name, sdpOffer }: ReferenceRobot): boolean {
    if (name !== this.#name) {
      if (this.others.size < MAX_OTHERS) this.others.add(name);
      return false;
    }
    this.#ids.add(id);
    return sdpOffer !== null;
  }
}

function toOffer({ id, sdpOffer, robotCandidates }: ReferenceRobot): OpenOffer {
  return { robotId: id, sdpOffer: sdpOffer ?? '', candidates: robotCandidates };
}
