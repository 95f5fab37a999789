/** What discovery shows about other participants, in ROS terms, and what in it is incompatible with us. */
import { type GraphTopic, type Qos, RosFault } from '@farpoint/ros';
import { fromDdsTopic, fromDdsType } from './ros-names.ts';

/** A publisher or subscriber of another participant. */
export interface OtherEndpoint {
  topic: string;
  /** In ROS notation; unchanged if it is not a ROS type. */
  type: string;
  reliable: boolean;
  transientLocal: boolean;
}

/** One of our own endpoints. */
export interface OwnEndpoint {
  topic: string;
  type: string;
  qos: Qos;
}

/**
 * @param values four per endpoint: topic, type, reliable, transient-local; services and endpoints without ROS names are
 * left out
 */
export function readOthers(values: readonly (string | boolean)[]): OtherEndpoint[] {
  const others: OtherEndpoint[] = [];
  for (let i = 0; i + 3 < values.length; i += 4) {
    const [name, dds, reliable, transientLocal] = values.slice(i, i + 4) as [
      string,
      string,
      boolean,
      boolean,
    ];
    const topic = fromDdsTopic(name);
    if (topic !== null) others.push({ topic, type: fromDdsType(dds) ?? dds, reliable, transientLocal });
  }
  return others;
}

/** @param values see {@link readOthers} @returns the types of the endpoints of one DDS topic, in DDS notation */
export function typesOn(values: readonly (string | boolean)[], ddsTopic: string): string[] {
  return values.flatMap((name, i) => (i % 4 === 0 && name === ddsTopic ? [String(values[i + 1])] : []));
}

export function topicsOf(
  publishers: readonly OtherEndpoint[],
  subscribers: readonly OtherEndpoint[],
): GraphTopic[] {
  const topics = new Map<string, GraphTopic>();
  const count = ({ topic, type }: OtherEndpoint, side: 'publishers' | 'subscribers') => {
    const key = `${topic} ${type}`;
    const entry = topics.get(key) ?? { topic, type, publishers: 0, subscribers: 0 };
    entry[side]++;
    topics.set(key, entry);
  };
  for (const each of publishers) count(each, 'publishers');
  for (const each of subscribers) count(each, 'subscribers');
  return [...topics.values()].sort((a, b) => (a.topic < b.topic ? -1 : a.topic > b.topic ? 1 : 0));
}

/** Publishers from which one of our subscriptions will never receive anything. */
export function subscriptionFaults(own: OwnEndpoint, publishers: readonly OtherEndpoint[]): RosFault[] {
  return publishers
    .filter(({ topic }) => topic === own.topic)
    .flatMap((other) => {
      if (other.type !== own.type) return [wrongType(own, other, 'published')];
      return refusals(own.topic, own.qos, qosOf(other), 'the publisher', 'our subscription');
    });
}

/** Subscribers that will never receive anything from one of our publishers. */
export function publisherFaults(own: OwnEndpoint, subscribers: readonly OtherEndpoint[]): RosFault[] {
  return subscribers
    .filter(({ topic }) => topic === own.topic)
    .flatMap((other) => {
      if (other.type !== own.type) return [wrongType(own, other, 'subscribed')];
      return refusals(own.topic, qosOf(other), own.qos, 'our publisher', 'the subscriber');
    });
}

type Guarantees = Pick<Qos, 'reliability' | 'durability'>;

function qosOf({ reliable, transientLocal }: OtherEndpoint): Guarantees {
  return {
    reliability: reliable ? 'reliable' : 'best-effort',
    durability: transientLocal ? 'transient-local' : 'volatile',
  };
}

function wrongType(own: OwnEndpoint, other: OtherEndpoint, how: string): RosFault {
  return new RosFault('wrong-type', `is ${how} as ${other.type}, not ${own.type}`, {
    topic: own.topic,
    remedy: 'name the same type on both sides',
  });
}

/** DDS rule: a subscriber that requests more than is offered receives nothing. */
function refusals(
  topic: string,
  asked: Guarantees,
  offered: Guarantees,
  offering: string,
  asking: string,
): RosFault[] {
  const lacking: string[] = [];
  if (asked.reliability === 'reliable' && offered.reliability !== 'reliable')
    lacking.push('reliability best-effort, not reliable');
  if (asked.durability === 'transient-local' && offered.durability !== 'transient-local')
    lacking.push('durability volatile, not transient-local');
  return lacking.map(
    (what) =>
      new RosFault('refused', `${offering} has ${what} as ${asking} asks`, {
        topic,
        remedy: 'request no more than is offered (qos)',
      }),
  );
}
