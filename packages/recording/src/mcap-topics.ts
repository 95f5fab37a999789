import { lazyDecoder, ros2TypeOf } from '@farpoint/ros';
import type { McapTypes } from '@mcap/core';
import type { RecordedTopic } from './recording.ts';

/**
 * One topic per channel. Two channels may have the same topic (two publishers): each keeps its own schema.
 *
 * @param count messages of a channel; `null` if unknown
 */
export function topicsOf(
  channels: Iterable<McapTypes.Channel>,
  schemas: ReadonlyMap<number, McapTypes.Schema>,
  count: ((channel: number) => number) | null,
): { topics: RecordedTopic[]; byChannel: Map<number, RecordedTopic> } {
  const byChannel = new Map<number, RecordedTopic>();
  for (const { id, topic, schemaId, messageEncoding, metadata } of channels) {
    const schema = schemas.get(schemaId);
    byChannel.set(id, {
      name: topic,
      metadata,
      type: ros2TypeOf(schema?.name ?? ''),
      messages: count?.(id) ?? null,
      decode: lazyDecoder({
        name: schema?.name ?? '',
        messageEncoding,
        schemaEncoding: schema?.encoding ?? '',
        schema: schema?.data ?? new Uint8Array(0),
      }),
    });
  }
  return { topics: [...byChannel.values()], byChannel };
}
