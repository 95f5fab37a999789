import type { MessageData } from '@farpoint/protocol';

/** The other end of a socket, as the core sees it: independent of real sockets. */
export interface Peer {
  /** Unique in this process, for logs. */
  readonly id: number;
  /** IP address, for logs. */
  readonly address: string;
  /** Bytes accepted but not yet handed to the network. */
  readonly backlog: number;
  /** Queues one text message (bytes must be UTF-8). Never throws; does nothing once the peer is closed. */
  send(message: string | Uint8Array): void;
  /** Closes the connection with a WebSocket close code (RFC 6455 §7.4). `closed()` is called later. */
  close(code: number, reason: string): void;
}

/** A hub's end of a connection. The socket's owner passes in messages and the end. */
export interface Connection {
  receive(data: MessageData): void;
  /** The socket has closed. Called exactly once. */
  closed(): void;
  /** The service is stopping: tell the peer and close. */
  shutDown(): void;
}

/** Close codes in use: RFC 6455 §7.4.1 and the IANA registry of WebSocket close codes. */
export const closeCodes = {
  goingAway: 1001,
  policyViolation: 1008,
  serviceRestart: 1012,
  tryAgainLater: 1013,
} as const;
