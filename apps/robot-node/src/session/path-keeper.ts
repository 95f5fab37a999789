import type { RobotToService } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import type { DriveStation } from '../drive/drive-station.ts';
import type { ConnectedOperator } from './connected-operator.ts';
import { type SilenceLimits, silenceStep } from './silence.ts';

export interface PathKeeperOptions {
  operators: ReadonlyMap<string, ConnectedOperator>;
  limits: SilenceLimits;
  drive: DriveStation;
  signaling: {
    send(message: RobotToService): boolean;
    /** Is the line alive? Find out soon. */
    check(): void;
  };
  leaseChanged: () => void;
  log: Logger;
  now: () => number;
}

/** Keeps sessions whose path is lost, as long as that makes sense, and offers new paths when operators ask. */
export class PathKeeper {
  readonly #options: PathKeeperOptions;
  /** ICE restarts offered. */
  restarts = 0;

  constructor(options: PathKeeperOptions) {
    this.#options = options;
  }

  /** Every 25 ms. */
  tick(): void {
    const { operators, limits, drive, signaling, leaseChanged, now } = this.#options;
    for (const operator of [...operators.values()]) {
      operator.tick();
      if (operator.sender === null) continue;
      const silentMs = now() - operator.heardMs;
      operator.quiet = silentMs > limits.streamMs;
      const step = silenceStep(silentMs, limits);
      if (step === 'none') continue;
      signaling.check();
      if (step === 'release-lease' && drive.guard.releaseLease(operator.session.id)) {
        drive.apply();
        leaseChanged();
      } else if (step === 'end') {
        operator.peer.close('silent', `nothing heard for ${limits.sessionMs / 1000} s`);
      }
    }
  }

  /** An operator hears nothing and asks for a new path. */
  async resume(session: string): Promise<void> {
    const { operators, signaling, log, now } = this.#options;
    const operator = operators.get(session);
    if (operator === undefined) {
      signaling.send({ type: 'session.close', session });
      return;
    }
    // While it is being set up it has an offer already.
    if (!operator.peer.connected || !operator.restarts.request(now())) return;
    try {
      const sdp = await operator.peer.restart();
      this.restarts++;
      log.info({ session, silentMs: Math.round(now() - operator.heardMs) }, 'ICE restart offered');
      if (operators.get(session) === operator) signaling.send({ type: 'session.offer', session, sdp });
    } catch (error) {
      log.error({ err: error, session }, 'no offer');
      operator.peer.close('connection-lost', 'no offer could be made');
    }
  }
}
