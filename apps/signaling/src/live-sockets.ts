import type { WebSocket } from 'ws';
import type { Admission } from './admission.ts';
import { Heartbeat } from './heartbeat.ts';
import type { Observer, Role } from './observer.ts';
import type { Connection, Peer } from './peer.ts';
import { SocketPeer } from './socket-peer.ts';

export interface LiveSocketsOptions {
  readonly heartbeatMs: number;
  readonly maxBacklogBytes: number;
  readonly admission: Admission;
  readonly observer: Observer;
}

/** All open WebSockets, from acceptance to end. */
export class LiveSockets {
  readonly #options: LiveSocketsOptions;
  readonly #heartbeat: Heartbeat;
  readonly #live = new Map<SocketPeer, Connection>();
  readonly #byRole: Record<Role, number> = {
    robot: 0,
    operator: 0,
    'reference-robot': 0,
    'reference-client': 0,
  };
  #nextPeerId = 1;
  #onEmpty: (() => void) | null = null;

  constructor(options: LiveSocketsOptions) {
    this.#options = options;
    this.#heartbeat = new Heartbeat(options.heartbeatMs);
  }

  /** Number of sockets by role; the same object at every call. */
  get byRole(): Readonly<Record<Role, number>> {
    return this.#byRole;
  }

  /** @param connect creates the hub's end of the connection */
  accept(socket: WebSocket, role: Role, address: string, connect: (peer: Peer) => Connection): void {
    const { maxBacklogBytes, admission, observer } = this.#options;
    const peer = new SocketPeer(socket, {
      id: this.#nextPeerId++,
      address,
      maxBacklogBytes,
      onDropped: (reason) => observer.rejected(role, reason, address),
    });
    const leave = admission.enter(address);
    const removePulse = this.#heartbeat.add(peer);
    const connection = connect(peer);
    this.#byRole[role]++;
    this.#live.set(peer, connection);
    peer.attach(connection, () => {
      leave();
      removePulse();
      this.#byRole[role]--;
      this.#live.delete(peer);
      if (this.#live.size === 0) this.#onEmpty?.();
    });
  }

  /**
   * Tells every peer that the service is stopping, waits up to `waitMs` for them to hang up, then closes all sockets.
   */
  async shutDown(waitMs: number): Promise<void> {
    this.#heartbeat.stop();
    for (const connection of [...this.#live.values()]) connection.shutDown();
    if (this.#live.size > 0) {
      await new Promise<void>((resolve) => {
        const timer = setTimeout(resolve, waitMs);
        this.#onEmpty = () => {
          clearTimeout(timer);
          resolve();
        };
      });
    }
    for (const peer of this.#live.keys()) peer.terminate();
  }
}
