import type { WebSocket } from 'ws';

const HEARTBEAT_MS = 10_000;
/**
 * A ping that checks a doubtful connection must be answered within this time, ms; otherwise the connection is given
 * up.
 */
const CHECK_TIMEOUT_MS = 2000;
/** Shortest interval between such pings, ms. The service disconnects clients that ping without limit. */
const CHECK_INTERVAL_MS = 500;

/** Pings one connection, at intervals and on demand, and terminates it if no answer comes. */
export class Liveness {
  /** Why it terminated the connection; empty if it did not. */
  fault = '';
  readonly #socket: Pick<WebSocket, 'ping' | 'terminate'>;
  #alive = true;
  #heartbeat: NodeJS.Timeout | null = null;
  #checking: NodeJS.Timeout | null = null;
  #checkedMs = Number.NEGATIVE_INFINITY;

  constructor(socket: Pick<WebSocket, 'ping' | 'terminate'>) {
    this.#socket = socket;
  }

  /** Call this once the connection is open. */
  start(): void {
    this.#heartbeat = setInterval(() => {
      if (!this.#alive) {
        this.#giveUp();
        return;
      }
      this.#alive = false;
      this.#socket.ping();
    }, HEARTBEAT_MS);
  }

  /** Something came from the other side. */
  heard(): void {
    this.#alive = true;
    if (this.#checking !== null) clearTimeout(this.#checking);
    this.#checking = null;
  }

  /** Asks for a sign of life now, unless it did a moment ago. */
  check(): void {
    const nowMs = performance.now();
    if (this.#checking !== null || nowMs - this.#checkedMs < CHECK_INTERVAL_MS) return;
    this.#checkedMs = nowMs;
    this.#checking = setTimeout(() => this.#giveUp(), CHECK_TIMEOUT_MS);
    this.#socket.ping();
  }

  stop(): void {
    if (this.#heartbeat !== null) clearInterval(this.#heartbeat);
    if (this.#checking !== null) clearTimeout(this.#checking);
  }

  #giveUp(): void {
    this.fault = 'no answer to a ping';
    this.#socket.terminate();
  }
}
