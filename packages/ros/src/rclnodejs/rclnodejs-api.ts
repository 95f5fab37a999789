/**
 * The parts of rclnodejs 2 that we use, as they really are: its own declarations describe counts as methods that are in
 * fact properties. Source: lib/node.js, lib/publisher.js, lib/subscription.js, lib/qos.js.
 */
import * as z from 'zod';
import type { Qos } from '../graph.ts';

export interface RclSubscription {
  readonly publisherCount: number;
}

export interface RclPublisher {
  readonly subscriptionCount: number;
  /** A `Buffer` is sent unchanged. */
  publish(message: Buffer): void;
  /** @param timeout ns */
  waitForAllAcked(timeout: bigint): boolean;
}

export interface RclNode {
  createSubscription(
    type: string,
    topic: string,
    options: { isRaw: true; qos: object },
    onMessage: (message: Buffer) => void,
  ): RclSubscription;
  createPublisher(type: string, topic: string, options: { qos: object }): RclPublisher;
  destroySubscription(subscription: RclSubscription): void;
  destroyPublisher(publisher: RclPublisher): void;
  getTopicNamesAndTypes(): unknown;
  getPublishersInfoByTopic(topic: string, noDemangle: boolean): unknown;
  getSubscriptionsInfoByTopic(topic: string, noDemangle: boolean): unknown;
  /** Delivers on the event loop; waits in its own thread. @param timeout ms */
  spin(timeout: number): void;
  destroy(): void;
}

export interface Rclnodejs {
  init(): Promise<void>;
  shutdown(): void;
  Node: new (name: string, namespace: string, context: object, options: object) => RclNode;
  NodeOptions: new () => { startParameterServices: boolean; enableRosout: boolean };
  QoS: new (...values: QosValues) => object;
  Context: { defaultContext(): object };
}

/** History, depth, reliability, durability, with rmw's numbers. */
export type QosValues = [number, number, number, number];

const KEEP_LAST = 1;
const RELIABILITY = { reliable: 1, 'best-effort': 2 } as const;
const DURABILITY = { 'transient-local': 1, volatile: 2 } as const;

/** Source: rmw/types.h. */
export function qosValues({ reliability, durability, depth }: Qos): QosValues {
  return [KEEP_LAST, depth, RELIABILITY[reliability], DURABILITY[durability]];
}

const callable = z.custom<(...values: never[]) => unknown>((value) => typeof value === 'function');
export const rclnodejsSchema = z.looseObject({
  init: callable,
  shutdown: callable,
  Node: callable,
  NodeOptions: callable,
  QoS: callable,
  Context: callable.refine((context) => 'defaultContext' in context),
});

/** Result of `getTopicNamesAndTypes`. */
export const topicNamesSchema = z.array(z.object({ name: z.string(), types: z.array(z.string()) }));
/** Result of `getPublishersInfoByTopic` and its counterpart for subscriptions. */
export const endpointsSchema = z.array(
  z.object({ node_name: z.string(), node_namespace: z.string(), topic_type: z.string() }),
);
export type Endpoints = z.infer<typeof endpointsSchema>;
