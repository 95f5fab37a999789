/** The master’s answers, validated. */
import type { RosMasterClient } from '@foxglove/ros1';
import * as z from 'zod';
import type { GraphTopic } from '../graph.ts';
import { ros2TypeOf } from '../topic-table.ts';

/** A master that does not answer for this long is gone, ms. */
const ANSWER_MS = 2000;
const OK = 1;

const nodesOfTopics = z.array(z.tuple([z.string(), z.array(z.string())]));
const systemState = z.tuple([nodesOfTopics, nodesOfTopics, z.unknown()]);
const topicTypes = z.array(z.tuple([z.string(), z.string()]));
const urls = z.array(z.string());
const url = z.string();

/** Who publishes and subscribes to what, nodes by name. */
export interface MasterState {
  publishers: ReadonlyMap<string, readonly string[]>;
  subscribers: ReadonlyMap<string, readonly string[]>;
  topics: readonly GraphTopic[];
}

export class Master {
  readonly #client: RosMasterClient;
  readonly #name: string;
  readonly #ownUrl: string;

  /**
   * @param name of the calling node
   * @param ownUrl where others reach it
   */
  constructor(client: RosMasterClient, name: string, ownUrl: string) {
    this.#client = client;
    this.#name = name;
    this.#ownUrl = ownUrl;
  }

  /** @throws {Error} if it does not answer */
  async state(): Promise<MasterState> {
    const [published, subscribed] = systemState.parse(await answer(this.#client.getSystemState(this.#name)));
    const types = new Map(topicTypes.parse(await answer(this.#client.getTopicTypes(this.#name))));
    const publishers = new Map(published);
    const subscribers = new Map(subscribed);
    const names = new Set([...publishers.keys(), ...subscribers.keys()]);
    const topics = [...names].map((topic) => ({
      topic,
      type: ros2TypeOf(types.get(topic) ?? ''),
      publishers: publishers.get(topic)?.length ?? 0,
      subscribers: subscribers.get(topic)?.length ?? 0,
    }));
    return { publishers, subscribers, topics };
  }

  /** @returns the addresses of its publishers @throws {Error} */
  async registerSubscriber(topic: string, type: string): Promise<string[]> {
    return urls.parse(await answer(this.#client.registerSubscriber(this.#name, topic, type, this.#ownUrl)));
  }

  /** @throws {Error} */
  async registerPublisher(topic: string, type: string): Promise<void> {
    await answer(this.#client.registerPublisher(this.#name, topic, type, this.#ownUrl));
  }

  /** @returns where the service is, `rosrpc://host:port` @throws {Error} if there is none, or the master does not answer */
  async serviceUrl(service: string): Promise<string> {
    return url.parse(await answer(this.#client.lookupService(this.#name, service)));
  }

  /** @throws {Error} */
  async unregisterSubscriber(topic: string): Promise<void> {
    await answer(this.#client.unregisterSubscriber(this.#name, topic, this.#ownUrl));
  }

  /** @throws {Error} */
  async unregisterPublisher(topic: string): Promise<void> {
    await answer(this.#client.unregisterPublisher(this.#name, topic, this.#ownUrl));
  }
}

async function answer(call: Promise<readonly [number, string, unknown?]>): Promise<unknown> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(`no answer within ${ANSWER_MS / 1000} s`)), ANSWER_MS);
  });
  try {
    const [code, message, value] = await Promise.race([call, late]);
    if (code !== OK) throw new Error(message);
    return value;
  } finally {
    clearTimeout(timer);
  }
}
