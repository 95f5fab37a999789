import { shortHash } from '@farpoint/audit';
import type { IceServer, ResumeRefusal, RobotToService, ServiceToRobot } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { TokenBucket } from '@farpoint/timing';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { DriveStation } from '../../motion/drive/drive-station.ts';
import type { OperatorSession } from './operator-session.ts';
import { type SilenceLimits, silenceStep } from './silence.ts';

export type ResumeRequest = Extract<ServiceToRobot, { type: 'session.resume' }>;

/** The parts of an operator session that {@link PathKeeper} uses. */
export type KeptOperator = Pick<
  OperatorSession,
  'update' | 'heardMs' | 'quiet' | 'messages' | 'restarts' | 'resumeKey'
> & {
  /** `null` while there is no path yet. */
  readonly sender: unknown;
  readonly peer: Pick<OperatorSession['peer'], 'connected' | 'close' | 'restart' | 'useIceServers'>;
};

export interface PathKeeperOptions {
  operators: () => ReadonlyMap<string, KeptOperator>;
  limits: SilenceLimits;
  drive: DriveStation;
  signaling: {
    send(message: RobotToService): boolean;
    /** Checks soon whether the connection is alive. */
    check(): void;
  };
  leaseChanged: () => void;
  counters: Pick<RobotCounters, 'iceRestarts' | 'resumesRefused'>;
  log: Logger;
  now: () => number;
}

/** Keeps sessions that have lost their path, within the limits on silence, and offers new paths on request. */
export class PathKeeper {
  readonly #options: PathKeeperOptions;
  readonly #refusals = new TokenBucket({ perSecond: 5, burst: 10 });

  constructor(options: PathKeeperOptions) {
    this.#options = options;
  }

  /** Updates each operator, and acts on its silence. Call every 25 ms. */
  update(): void {
    const { operators, limits, drive, signaling, leaseChanged, now } = this.#options;
    for (const operator of [...operators().values()]) {
      operator.update();
      if (operator.sender === null) continue;
      const silentMs = now() - operator.heardMs;
      operator.quiet = silentMs > limits.streamMs;
      const { messages } = operator;
      if (now() - messages.heardMs > limits.leaseMs && drive.guard.releaseLease(messages.id)) {
        drive.apply();
        leaseChanged();
      }
      const step = silenceStep(silentMs, limits);
      if (step === 'none') continue;
      signaling.check();
      if (step === 'end') {
        operator.peer.close('silent', `nothing heard for ${limits.sessionMs / 1000} s`);
      }
    }
  }

  /**
   * An operator hears nothing and asks for a new path. An ICE restart gives up the sockets of the existing path, so
   * only an operator who proves that the session is its own gets one.
   */
  async resume(request: ResumeRequest, iceServers: readonly IceServer[]): Promise<void> {
    const { operators, signaling, counters, log, now } = this.#options;
    const { session, claim } = request;
    const operator = operators().get(session);
    if (operator === undefined) return this.#refuse(request, 'unknown-session');
    if (!operator.resumeKey.matches(request.resumeKey)) return this.#refuse(request, 'wrong-resume-key');
    // A session that is still being set up already has an offer.
    if (!operator.peer.connected || !operator.restarts.request(now())) {
      return this.#refuse(request, 'resume-too-soon');
    }
    operator.peer.useIceServers(iceServers);
    try {
      const sdp = await operator.peer.restart();
      counters.iceRestarts++;
      const silentMs = Math.round(now() - operator.heardMs);
      log.info({ session: shortHash('session', session), silentMs }, 'ICE restart offered');
      if (operators().get(session) === operator)
        signaling.send({ type: 'session.offer', session, sdp, claim });
    } catch (error) {
      log.error({ err: error, session: shortHash('session', session) }, 'no offer');
      operator.peer.close('connection-lost', 'no offer could be made');
    }
  }

  #refuse({ session, claim, operator }: ResumeRequest, code: ResumeRefusal): void {
    const { signaling, counters, log, now } = this.#options;
    counters.resumesRefused.add(code);
    log.debug({ session: shortHash('session', session), operator, code }, 'session not resumed');
    // Endless requests must not use up the rate at which the service lets the robot send.
    if (this.#refusals.take(now())) signaling.send({ type: 'session.refuse', session, claim, code });
  }
}
