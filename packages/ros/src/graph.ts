/**
 * A live ROS graph, whatever carries it: ROS 1 by its master, ROS 2 by DDS. Bytes in, bytes out; nothing is known here of
 * what messages hold. Types are named as ROS 2 does, `sensor_msgs/msg/PointCloud2`, also for ROS 1.
 */
import type { RosFault } from './fault.ts';

/** What subscriber and publisher of ROS 2 must agree on. ROS 1 has TCP, and latching for `transient-local`. */
export interface Qos {
  reliability: 'reliable' | 'best-effort';
  durability: 'volatile' | 'transient-local';
  /** Messages kept for who is slow, or comes late. */
  depth: number;
}

/** As rmw's sensor data: takes what publishers of either reliability send, newest first. */
export const SENSOR_QOS: Qos = { reliability: 'best-effort', durability: 'volatile', depth: 5 };
/** As rclcpp's default for publishers of few messages. */
export const RELIABLE_QOS: Qos = { reliability: 'reliable', durability: 'volatile', depth: 10 };
/** As static transforms are published. */
export const LATCHED_QOS: Qos = { reliability: 'reliable', durability: 'transient-local', depth: 100 };
/** As Nav2 publishes velocities and twist_mux takes them: an old one is worth nothing. */
export const VELOCITY_QOS: Qos = { reliability: 'reliable', durability: 'volatile', depth: 1 };

export interface SubscribeTo {
  /** With its leading slash. */
  topic: string;
  type: string;
  /** Left out: {@link SENSOR_QOS}. */
  qos?: Qos | undefined;
  /** Messages that may wait to be handed over; beyond it the oldest is dropped and counted. */
  queue: number;
}

/** @param bytes a serialised message, good only during the call @param receivedMs the clock that the graph was given */
export type OnMessage = (bytes: Uint8Array, receivedMs: number) => void;

export interface Subscription {
  readonly topic: string;
  readonly received: number;
  /** Received and not handed over. */
  readonly dropped: number;
  /** How many publish it now, as far as known. */
  readonly publishers: number;
  /** Definition of its messages as the publisher tells it (ROS 1, once connected); `null` where nobody does. */
  readonly definition: string | null;
  close(): void;
}

export interface AdvertiseAs {
  topic: string;
  type: string;
  /** Left out: {@link RELIABLE_QOS}. */
  qos?: Qos | undefined;
}

export interface Publisher {
  readonly topic: string;
  readonly subscribers: number;
  /** Without anybody who subscribes nothing is sent. @param bytes a serialised message, copied before it returns */
  publish(bytes: Uint8Array): void;
  close(): void;
}

/** What discovery sees of a topic. */
export interface GraphTopic {
  topic: string;
  type: string;
  publishers: number;
  subscribers: number;
}

export interface RosGraph {
  readonly version: 1 | 2;
  /** Nothing is subscribed that was not asked for here. */
  subscribe(to: SubscribeTo, onMessage: OnMessage): Subscription;
  /** Nothing is published that was not asked for here. */
  advertise(as: AdvertiseAs): Publisher;
  topics(): readonly GraphTopic[];
  /** Called for what may pass: a master that is gone, a peer that speaks another type. What was wrong before is told at once. */
  onFault: ((fault: RosFault) => void) | null;
  close(): Promise<void>;
}
