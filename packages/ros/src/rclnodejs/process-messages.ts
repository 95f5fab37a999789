/** Messages between the robot and the process in which rclnodejs runs. */
import type { RosFaultCode } from '../fault.ts';
import type { GraphTopic, Qos } from '../graph.ts';

export interface Endpoint {
  id: number;
  topic: string;
  type: string;
  qos: Qos;
}

export type ProcessRequest =
  | { is: 'subscribe'; endpoint: Endpoint; queue: number }
  | { is: 'advertise'; endpoint: Endpoint }
  | { is: 'publish'; id: number; bytes: Uint8Array }
  /** A message was delivered: there is room for another. */
  | { is: 'taken'; id: number }
  | { is: 'remove'; id: number }
  | { is: 'close' };

/** Counters of one subscription or publisher. */
export interface EndpointCounts {
  id: number;
  received: number;
  dropped: number;
  /** Number of endpoints at the other end. */
  others: number;
}

export type ProcessReport =
  | { is: 'ready' }
  /** The process cannot continue. */
  | { is: 'failed'; what: string; remedy: string | undefined }
  | { is: 'fault'; code: RosFaultCode; what: string; topic: string }
  /** @param receivedMs CLOCK_MONOTONIC */
  | { is: 'message'; id: number; bytes: Uint8Array; receivedMs: number }
  | { is: 'counts'; counts: EndpointCounts[] }
  | { is: 'topics'; topics: GraphTopic[] };

/** Start parameters of the process, as JSON. */
export interface ProcessSetup {
  name: string;
  /** Entry point of rclnodejs. */
  entry: string;
}
