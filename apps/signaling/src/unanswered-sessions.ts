import { isLoopbackHost } from '@farpoint/protocol';
import { addressKey } from '@farpoint/service';

/** As many as a person opens by reloading a page a few times, and fewer than the places of a robot. */
const MAX_UNANSWERED = 3;

/** What is needed of a session. */
export interface Asked {
  readonly robot: { readonly id: string };
  readonly operator: { readonly peer: { readonly address: string } };
}

/**
 * Sessions that operators have requested and not yet answered, by robot and by source: an IPv4 address or an IPv6 /64.
 * Each of them takes one of the robot's few places until it is answered or times out, so one source may have only a few.
 * Addresses of this machine have no limit: a proxy or a tunnel stands for many operators.
 */
export class UnansweredSessions<Session extends Asked> {
  readonly #bySource = new Map<string, Set<Session>>();

  hasRoom(robotId: string, address: string): boolean {
    if (isLoopbackHost(address)) return true;
    return (this.#bySource.get(sourceKey(robotId, address))?.size ?? 0) < MAX_UNANSWERED;
  }

  add(session: Session): void {
    const key = sourceKey(session.robot.id, session.operator.peer.address);
    const sessions = this.#bySource.get(key);
    if (sessions === undefined) this.#bySource.set(key, new Set([session]));
    else sessions.add(session);
  }

  /** The session has been answered or has ended. May be called more than once. */
  remove(session: Session): void {
    const key = sourceKey(session.robot.id, session.operator.peer.address);
    const sessions = this.#bySource.get(key);
    if (sessions?.delete(session) === true && sessions.size === 0) this.#bySource.delete(key);
  }
}

function sourceKey(robotId: string, address: string): string {
  return `${addressKey(address)} ${robotId}`;
}
