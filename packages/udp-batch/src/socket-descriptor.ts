import type { Socket } from 'node:dgram';
import type { Addon } from './addon.ts';

interface HandleShape {
  /** Negative once it is closed. */
  readonly fd: number;
}

/**
 * The descriptor of a socket, which Node keeps to itself. It is read anew before each use, because its number may belong
 * to something else as soon as the socket is closed, and it counts only if the system confirms that it is this socket.
 */
export class SocketDescriptor {
  readonly #socket: Socket;
  readonly #addon: Pick<Addon, 'udpPort'>;
  /** The handle that was confirmed. */
  #confirmed: HandleShape | null = null;

  constructor(socket: Socket, addon: Pick<Addon, 'udpPort'>) {
    this.#socket = socket;
    this.#addon = addon;
  }

  /** Valid until the end of the turn; `null` if the socket is closed, is not bound yet, or is not as expected. */
  get(): number | null {
    const handle = handleOf(this.#socket);
    if (handle === null) return null;
    const { fd } = handle;
    if (typeof fd !== 'number' || !Number.isInteger(fd) || fd < 0) return null;
    if (handle !== this.#confirmed) {
      const port = portOf(this.#socket);
      if (port === 0 || this.#addon.udpPort(fd) !== port) return null;
      this.#confirmed = handle;
    }
    return fd;
  }
}

/** `_handle` is the same, but Node warns of its use. */
function handleOf(socket: Socket): HandleShape | null {
  const key = Object.getOwnPropertySymbols(socket).find(({ description }) => description === 'state symbol');
  if (key === undefined) return null;
  const { handle } = ((socket as unknown as Record<symbol, unknown>)[key] ?? {}) as { handle?: unknown };
  return typeof handle === 'object' && handle !== null ? (handle as HandleShape) : null;
}

/** 0 if it is not bound. */
function portOf(socket: Socket): number {
  try {
    return socket.address().port;
  } catch {
    return 0;
  }
}
