/**
 * A live ROS graph, independent of its transport: ROS 1 through its master, ROS 2 through DDS. It passes bytes and does
 * not know what messages contain. Types are in ROS 2 notation, `sensor_msgs/msg/PointCloud2`, also for ROS 1.
 */
import type { MessageDefinition } from '@foxglove/message-definition';
import type { RosFault } from './fault.ts';

/** Settings that subscriber and publisher of ROS 2 must agree on. ROS 1 has TCP, and latching for `transient-local`. */
export interface Qos {
  reliability: 'reliable' | 'best-effort';
  durability: 'volatile' | 'transient-local';
  /** Messages kept for subscribers that are slow or join late. */
  depth: number;
}

/** As rmw's sensor data profile: accepts publishers of either reliability, newest message first. */
export const SENSOR_QOS: Qos = { reliability: 'best-effort', durability: 'volatile', depth: 5 };
/** As rclcpp's default for publishers of infrequent messages. */
export const RELIABLE_QOS: Qos = { reliability: 'reliable', durability: 'volatile', depth: 10 };
/** As used for static transforms. */
export const LATCHED_QOS: Qos = { reliability: 'reliable', durability: 'transient-local', depth: 100 };
/** As Nav2 publishes velocities and twist_mux receives them: an old velocity is worthless. */
export const VELOCITY_QOS: Qos = { reliability: 'reliable', durability: 'volatile', depth: 1 };

export interface SubscribeTo {
  /** With its leading slash. */
  topic: string;
  type: string;
  /** Default: {@link SENSOR_QOS}. */
  qos?: Qos | undefined;
  /** How many messages may wait for delivery; beyond that, the oldest is dropped and counted. */
  queue: number;
}

/**
 * @param bytes a serialised message, valid only during the call
 * @param receivedMs by the clock that was passed to the graph
 */
export type OnMessage = (bytes: Uint8Array, receivedMs: number) => void;

export interface Subscription {
  readonly topic: string;
  readonly received: number;
  /** Messages received but not delivered. */
  readonly dropped: number;
  /** Number of current publishers, as far as known. */
  readonly publishers: number;
  /** Definition of its messages as stated by the publisher (ROS 1, once connected); `null` if unknown. */
  readonly definition: string | null;
  close(): void;
}

export interface AdvertiseAs {
  topic: string;
  type: string;
  /** Of a type that is not one of ROS’s own, itself first. ROS 1 tells them to subscribers; ROS 2 needs none. */
  definitions?: readonly MessageDefinition[] | undefined;
  /** Default: {@link RELIABLE_QOS}. */
  qos?: Qos | undefined;
}

export interface Publisher {
  readonly topic: string;
  readonly subscribers: number;
  /** Sends nothing without subscribers. @param bytes a serialised message, copied before the call returns */
  publish(bytes: Uint8Array): void;
  close(): void;
}

/** A topic as discovery sees it. */
export interface GraphTopic {
  topic: string;
  type: string;
  publishers: number;
  subscribers: number;
}

/** A service by its full name, and the types of its messages in ROS 2 notation, `std_srvs/srv/Trigger_Request`. */
export interface ServiceAs {
  service: string;
  request: string;
  reply: string;
}

export interface ServiceClient {
  readonly service: string;
  /** Whether a call would be sent at once. */
  readonly isReady: boolean;
  /**
   * @param request a serialised message, copied before the call returns
   * @param withinMs the time that it has
   * @returns the serialised reply, of which a long one is cut
   * @throws {RosFault} (the promise rejects) `unavailable`: there is no such service; `wrong-type`; `unsupported`: its server
   *   speaks in another way; `refused`: too many calls are open; `lost`: the server has gone, or the time is over
   */
  call(request: Uint8Array, withinMs: number): Promise<Uint8Array>;
  close(): void;
}

export interface RosGraph {
  readonly version: 1 | 2;
  /** The only way to subscribe: the graph never subscribes to anything by itself. */
  subscribe(to: SubscribeTo, onMessage: OnMessage): Subscription;
  /** The only way to publish: the graph never publishes anything by itself. */
  advertise(as: AdvertiseAs): Publisher;
  topics(): readonly GraphTopic[];
  /**
   * Called for faults that may be temporary: a master that is gone, a peer that uses another type. Earlier faults are
   * reported at once.
   */
  onFault: ((fault: RosFault) => void) | null;
  close(): Promise<void>;
}

/** A graph in which services are called by clients that are there before the first call. */
export interface ServiceGraph extends RosGraph {
  /** @throws {RosFault} for names that are not valid */
  serviceClient(as: ServiceAs): ServiceClient;
}

export function callsServices(graph: RosGraph): graph is ServiceGraph {
  return 'serviceClient' in graph;
}
