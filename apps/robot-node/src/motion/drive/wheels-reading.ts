import { READING_LIMITS } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import { type SinkFault, sinkFaultWords } from '../../ground/velocity-sink.ts';

/**
 * What people should know about the wheels.
 *
 * @param topic where the velocities go
 * @param fault why nothing takes them; `null` if something does
 * @param well what to say if there is no fault
 */
export function wheelsReading(topic: string, fault: SinkFault | null, well: string): TopicReading {
  const words = fault === null ? well : sinkFaultWords[fault];
  const level = fault === null ? 'ok' : fault === 'starting' || fault === 'no-listener' ? 'warn' : 'error';
  const text = `${topic}: ${words}`;
  return { topic, label: 'Wheels', level, values: [['', text.length <= READING_LIMITS.text ? text : words]] };
}
