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
  | 'origin'
  | 'unknown-path';

/** What the core reports as it happens; the rim makes metrics and logs of it. */
export interface Observer {
  /** A robot is here. */
  robotJoined(role: Role, id: string | number, address: string, tookOver: boolean): void;
  robotLeft(role: Role, id: string | number): void;
  sessionOpened(session: string, robotId: string, operator: string): void;
  sessionClosed(session: string, reason: string): void;
  /** A message went through, `ms` after it came in. */
  relayed(type: string, ms: number): void;
  rejected(role: Role, reason: RejectReason, detail: string): void;
}
