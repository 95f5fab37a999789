import { RosFault } from '@farpoint/ros';

/** Messages that are older when they come are late, or of a clock that is behind, ms. */
export const LATE_MS = 1000;

/** That a topic's messages are older than that. */
export function lateFault(topic: string): RosFault {
  return new RosFault('bad-message', 'its messages are more than a second old when they come', {
    topic,
    remedy: 'they are late, or the publisher’s clock is behind: keep both clocks in step',
  });
}
