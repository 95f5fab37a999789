/** A ROS 2 graph over DDS. */
import {
  type AdvertiseAs,
  type GraphTopic,
  type OnMessage,
  type Publisher,
  type Qos,
  RELIABLE_QOS,
  RosFault,
  SENSOR_QOS,
  type ServiceAs,
  type ServiceClient,
  type ServiceGraph,
  type SubscribeTo,
  type Subscription,
} from '@farpoint/ros';
import { type Addon, type GraphHandle, loadAddon } from './addon.ts';
import { cycloneConfiguration, type DdsOptions, ddsOptionsFrom } from './configuration.ts';
import { DdsPublisher } from './dds-publisher.ts';
import { DdsServiceClient } from './dds-service-client.ts';
import { DdsSubscription } from './dds-subscription.ts';
import {
  type OtherEndpoint,
  type OwnEndpoint,
  publisherFaults,
  readOthers,
  subscriptionFaults,
  topicsOf,
  typesOn,
} from './discovery.ts';
import { toDdsTopic, toDdsType } from './ros-names.ts';

/** Delay from the first discovery event until the endpoints are read, ms. */
const LOOK_MS = 20;

export interface DdsGraphOptions extends DdsOptions {
  /** The clock of `receivedMs`, ms; CLOCK_MONOTONIC by default. */
  now?: () => number;
  /** The environment from which ROS's and CycloneDDS's variables are read; by default that of the process. */
  env?: Readonly<Record<string, string | undefined>>;
}

export class DdsGraph implements ServiceGraph {
  readonly version = 2;
  onFault: ((fault: RosFault) => void) | null = null;
  readonly #addon: Addon;
  readonly #handle: GraphHandle;
  readonly #now: () => number;
  readonly #subscriptions = new Map<DdsSubscription, OwnEndpoint>();
  readonly #publishers = new Map<DdsPublisher, OwnEndpoint>();
  readonly #clients = new Set<DdsServiceClient>();
  /**
   * Mismatches that discovery shows now, by their text. Each is reported once, and again after it has disappeared and
   * returned.
   */
  #standing: ReadonlySet<string> = new Set();
  #looking: NodeJS.Timeout | null = null;
  #closed = false;

  /**
   * @throws {RosFault} `unavailable`: the addon or its library is missing, an option is invalid, or there is no such
   * interface
   */
  constructor({ now = monotonicMs, env = process.env, ...options }: DdsGraphOptions = {}) {
    const checked = ddsOptionsFrom(options, env);
    this.#addon = loadAddon();
    this.#now = now;
    this.#addon.lastLog();
    try {
      const configuration = cycloneConfiguration(checked, env.CYCLONEDDS_URI);
      this.#handle = this.#addon.open(checked.domain ?? 0, configuration, () => this.#lookSoon());
    } catch (error) {
      throw openingFault(error, checked, this.#addon.lastLog());
    }
  }

  subscribe(to: SubscribeTo, onMessage: OnMessage): Subscription {
    const own = { topic: to.topic, type: to.type, qos: to.qos ?? SENSOR_QOS };
    const subscription = new DdsSubscription(
      this.#addon,
      this.#handle,
      { ...own, ...namesOf(own), queue: to.queue },
      {
        onMessage,
        onFault: (fault) => this.onFault?.(fault),
        onClose: (closed) => this.#subscriptions.delete(closed),
        now: this.#now,
      },
    );
    this.#subscriptions.set(subscription, own);
    this.#lookSoon();
    return subscription;
  }

  advertise(as: AdvertiseAs): Publisher {
    const own = { topic: as.topic, type: as.type, qos: as.qos ?? RELIABLE_QOS };
    const publisher = new DdsPublisher(this.#addon, this.#handle, { ...own, ...namesOf(own) }, (closed) =>
      this.#publishers.delete(closed),
    );
    this.#publishers.set(publisher, own);
    this.#lookSoon();
    return publisher;
  }

  serviceClient(as: ServiceAs): ServiceClient {
    const client = new DdsServiceClient(this.#addon, this.#handle, as, {
      typesOf: (ddsTopic) => typesOn(this.#addon.others(this.#handle, false), ddsTopic),
      onFault: (fault) => this.onFault?.(fault),
      onClose: (closed) => this.#clients.delete(closed),
      now: this.#now,
    });
    this.#clients.add(client);
    return client;
  }

  /** Of other participants: our own publishers and subscriptions do not count. */
  topics(): readonly GraphTopic[] {
    return this.#closed ? [] : topicsOf(this.#others('publishers'), this.#others('subscribers'));
  }

  close(): Promise<void> {
    if (this.#closed) return Promise.resolve();
    this.#closed = true;
    if (this.#looking !== null) clearTimeout(this.#looking);
    const own = [...this.#clients, ...this.#subscriptions.keys(), ...this.#publishers.keys()];
    for (const each of own) each.close();
    this.#addon.closeGraph(this.#handle);
    return Promise.resolve();
  }

  #others(side: 'publishers' | 'subscribers'): OtherEndpoint[] {
    return readOthers(this.#addon.others(this.#handle, side === 'publishers'));
  }

  /** Endpoints often appear and disappear in groups, which are read together. */
  #lookSoon(): void {
    this.#looking ??= setTimeout(() => {
      this.#looking = null;
      this.#look();
    }, LOOK_MS).unref();
  }

  /** Reports mismatches in what discovery shows that have not been reported. */
  #look(): void {
    if (this.#closed) return;
    for (const client of this.#clients) client.look();
    if (this.#subscriptions.size + this.#publishers.size === 0) return;
    const [publishers, subscribers] = [this.#others('publishers'), this.#others('subscribers')];
    const faults = [
      ...[...this.#subscriptions.values()].flatMap((own) => subscriptionFaults(own, publishers)),
      ...[...this.#publishers.values()].flatMap((own) => publisherFaults(own, subscribers)),
    ];
    const told = new Set(this.#standing);
    this.#standing = new Set(faults.map(({ message }) => message));
    for (const fault of faults) {
      if (!told.has(fault.message)) this.onFault?.(fault);
      told.add(fault.message);
    }
  }
}

/** @throws {RosFault} if they are not valid ROS names */
function namesOf({ topic, type }: { topic: string; type: string; qos: Qos }): {
  ddsTopic: string;
  ddsType: string;
} {
  const [ddsTopic, ddsType] = [toDdsTopic(topic), toDdsType(type)];
  if (ddsTopic === null)
    throw new RosFault('unsupported', `${topic} is not a complete topic name`, { topic });
  if (ddsType === null) throw new RosFault('unsupported', `${type} is not a message type`, { topic });
  return { ddsTopic, ddsType };
}

function openingFault(error: unknown, { domain, interface: network }: DdsOptions, said: string): RosFault {
  const { code, message } = error as NodeJS.ErrnoException;
  if (code === 'CONFIGURATION') {
    const what = `DDS domain ${domain} is in use in this process with another configuration`;
    return new RosFault('unavailable', what, { cause: error, remedy: 'give both graphs the same options' });
  }
  const at = network === undefined ? '' : ` on interface ${network}`;
  return new RosFault('unavailable', `DDS domain ${domain} could not be joined${at} (${said || message})`, {
    cause: error,
    remedy: 'check that the network interface exists and that CYCLONEDDS_URI is correct',
  });
}

function monotonicMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}
