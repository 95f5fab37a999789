import type { DriveRequest, Point, Spot } from '@farpoint/protocol';
import type { RobotLink } from '../link/robot-link.ts';

/**
 * What this operator asks of the others at the robot. Each method returns whether it was sent, which needs a session. The
 * `handover` event says what comes of it; the `robotFault` event, why nothing does.
 */
export class PeopleRequests {
  readonly #link: Pick<RobotLink, 'phase' | 'sendSession'>;

  /** @param link where requests go */
  constructor(link: Pick<RobotLink, 'phase' | 'sendSession'>) {
    this.#link = link;
  }

  /** Asks who drives for the drive. */
  askToDrive(): boolean {
    return this.#send({ type: 'driveAsk' });
  }

  /**
   * Offers the drive, which this operator has, to another. It keeps it until the other accepts.
   *
   * @param operator its `number` in the `operators` event
   */
  offerDrive(operator: number): boolean {
    return this.#send({ type: 'driveOffer', to: operator });
  }

  /**
   * Answers another's request or offer. Whoever gets the drive must open the grip before it moves the robot.
   *
   * @param id of the `handover` event
   */
  answer(id: number, accept: boolean): boolean {
    return this.#send({ type: 'driveAnswer', id, accept });
  }

  /**
   * Takes an own request or offer back.
   *
   * @param id of the `handover` event
   */
  withdraw(id: number): boolean {
    return this.#send({ type: 'driveWithdraw', id });
  }

  /**
   * Points at a spot, which the other operators see for 5 s, or until this operator points elsewhere. The robot passes on ten a
   * second.
   *
   * @param at in the robot's world (REP-103), metres
   */
  point(at: Spot): boolean {
    return this.#send({ type: 'point', at });
  }

  #send(request: DriveRequest | Point): boolean {
    if (this.#link.phase !== 'live') return false;
    this.#link.sendSession(request);
    return true;
  }
}
