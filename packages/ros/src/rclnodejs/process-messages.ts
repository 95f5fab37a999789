/** Between the robot and the process in which rclnodejs runs. */
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
  /** A message was handed over: there is room for another. */
  | { is: 'taken'; id: number }
  | { is: 'remove'; id: number }
  | { is: 'close' };

/** Of one subscription or publisher. */
export interface EndpointCounts {
  id: number;
  received: number;
  dropped: number;
  /** At the other end. */
  others: number;
}

export type ProcessReport =
  | { is: 'ready' }
  /** It cannot go on. */
  | { is: 'failed'; what: string; remedy: string | undefined }
  | { is: 'fault'; code: RosFaultCode; what: string; topic: string }
  /** @param receivedMs CLOCK_MONOTONIC */
  | { is: 'message'; id: number; bytes: Uint8Array; receivedMs: number }
  | { is: 'counts'; counts: EndpointCounts[] }
  | { is: 'topics'; topics: GraphTopic[] };

/** What the process is started with, as JSON. */
export interface ProcessSetup {
  name: string;
  /** Of rclnodejs. */
  entry: string;
}
