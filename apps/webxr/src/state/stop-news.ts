/** Tells when another operator has pressed STOP, and when another has released it. */
import type { RobotClient } from '@farpoint/operator';
import type { EstopCause, EstopState } from '@farpoint/protocol';
import { pressedNotice, releasedNotice } from '../words/stop-notices.ts';
import type { Notices } from './notices.ts';

export class StopNews {
  /** The last state in this session; `null` before the first. */
  #last: EstopState | null = null;
  #cause: EstopCause | null = null;
  #isOwnRelease = false;

  constructor(client: Pick<RobotClient, 'on' | 'link'>, notices: Pick<Notices, 'tell'>) {
    client.on('session', () => {
      this.#last = null;
      this.#isOwnRelease = false;
    });
    client.on('estop', (estop) => {
      const { estopCause, operators, lease } = client.link.session;
      const [last, isOwnRelease] = [this.#last, this.#isOwnRelease];
      this.#last = estop;
      this.#isOwnRelease = false;
      // Whoever connects to a robot that stands has missed nothing: the band says why.
      if (last === null || last.latched === estop.latched) {
        this.#cause = estop.latched ? estopCause : null;
        return;
      }
      const cause = estop.latched ? estopCause : this.#cause;
      this.#cause = cause;
      const text = estop.latched
        ? pressedNotice(estop, cause, operators)
        : isOwnRelease
          ? null
          : releasedNotice(last, cause, { operators, holder: lease.holder });
      // The band and the cue say how urgent it is.
      if (text !== null) notices.tell(text);
    });
  }

  /** This operator releases it. */
  onOwnRelease(): void {
    this.#isOwnRelease = true;
  }
}
