import type { GraphTopic } from '../graph.ts';
import type { Endpoints } from './rclnodejs-api.ts';

/** What other nodes publish and subscribe on a topic, by type; a node with our name is ourselves. */
export function othersOf(
  topic: string,
  own: string,
  publishers: Endpoints,
  subscribers: Endpoints,
): GraphTopic[] {
  const byType = new Map<string, GraphTopic>();
  const count = (endpoints: Endpoints, side: 'publishers' | 'subscribers') => {
    for (const { node_name, node_namespace, topic_type: type } of endpoints) {
      if (node_name === own && node_namespace === '/') continue;
      const entry = byType.get(type) ?? { topic, type, publishers: 0, subscribers: 0 };
      entry[side]++;
      byType.set(type, entry);
    }
  };
  count(publishers, 'publishers');
  count(subscribers, 'subscribers');
  return [...byType.values()];
}
