/** Tells when another operator has pressed STOP, and when another has released it. */
import type { RobotClient } from '@farpoint/operator';
import type { EstopCause, EstopState } from '@farpoint/protocol';
import { pressedNotice, releasedNotice, releaserWords } from '../words/stop-notices.ts';
import type { Notices } from './notices.ts';

/** The emergency stop was latched or released, or was found latched. */
export interface StopChange {
  readonly estop: EstopState;
  /** Of the latch that is on, or was; `null` if the robot does not say. */
  readonly cause: EstopCause | null;
  /** Whether it was found so when the session began. */
  readonly first: boolean;
  /** By whom it was released, as far as is known, and its name; `null` while it is latched. */
  readonly release: { readonly by: 'you' | 'operator' | 'robot'; readonly name: string | null } | null;
}

export class StopNews {
  /** Called for each change, whoever made it. */
  onChange: ((change: StopChange) => void) | null = null;
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
        if (last === null && estop.latched)
          this.onChange?.({ estop, cause: estopCause, first: true, release: null });
        return;
      }
      const cause = estop.latched ? estopCause : this.#cause;
      this.#cause = cause;
      const here = { operators, holder: lease.holder };
      const by = isOwnRelease ? 'you' : last.releasedAt === 'robot' ? 'robot' : 'operator';
      const release = estop.latched
        ? null
        : ({ by, name: by === 'operator' ? releaserWords(cause, here) : null } as const);
      this.onChange?.({ estop, cause, first: false, release });
      const text = estop.latched
        ? pressedNotice(estop, cause, operators)
        : isOwnRelease
          ? null
          : releasedNotice(last, cause, here);
      // The band and the cue say how urgent it is.
      if (text !== null) notices.tell(text);
    });
  }

  /** This operator releases it. */
  onOwnRelease(): void {
    this.#isOwnRelease = true;
  }
}
