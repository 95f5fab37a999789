import type { SignalingErrorCode } from '@farpoint/protocol';

export type Role = 'robot' | 'operator' | 'reference-robot' | 'reference-client';

/** Why something was refused, for counting. */
export type RejectReason =
  | SignalingErrorCode
  | 'no-offer' // an answer to a reference robot that has offered nothing
  | 'not-yours' // a reference robot that speaks for another one
  | 'too-many-faults' // closed after many refused messages
  | 'hello-overdue'
  | 'slow-consumer'
  | 'no-pong'
  | 'too-many-connections'
  | 'too-many-connections-per-address'
  | 'too-many-sockets' // TCP connections of one address, closed before anything is read
  | 'origin'
  | 'host'
  | 'unknown-path';

/** Receives the core's events, to turn them into metrics and log lines. */
export interface Observer {
  /** A robot has connected. */
  robotJoined(
    role: Role,
    id: string | number,
    address: string,
    tookOver: boolean,
    token?: string | undefined,
  ): void;
  robotLeft(role: Role, id: string | number): void;
  /** An operator has connected. */
  operatorJoined(name: string, address: string, token: string | undefined): void;
  operatorLeft(name: string): void;
  sessionOpened(session: string, robotId: string, operator: string): void;
  sessionClosed(session: string, reason: string): void;
  /** A message was relayed `ms` after it arrived. */
  relayed(type: string, ms: number): void;
  rejected(role: Role, reason: RejectReason, detail: string): void;
}
