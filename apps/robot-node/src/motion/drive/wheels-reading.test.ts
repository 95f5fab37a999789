import { readingSchema } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { sinkFaultWords } from '../../ground/velocity-sink.ts';
import { wheelsReading } from './wheels-reading.ts';

it.each(Object.keys(sinkFaultWords) as (keyof typeof sinkFaultWords)[])(
  'is a reading that a page takes, whatever the topic: %s',
  (fault) => {
    for (const topic of ['/cmd_vel', `/${'a'.repeat(90)}`]) {
      const reading = wheelsReading(topic, fault, 'ok');
      expect(readingSchema.safeParse({ type: 'reading', ...reading, ageMs: 0, timeMs: 0 }).error).toBe(
        undefined,
      );
      expect(reading.values[0]?.[1]).toContain(sinkFaultWords[fault]);
    }
  },
);
