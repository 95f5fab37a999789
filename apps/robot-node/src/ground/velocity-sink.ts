import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';

/** Why a sink's velocities move nothing. */
export type SinkFault =
  | 'starting' // not known yet whether anything takes them
  | 'thread-ended' // the thread that publishes them has ended; another is started
  | 'thread-hung' // it gives no sign of life
  | 'no-listener' // nobody subscribes
  | 'write-failed' // they cannot be written
  | 'reader-silent'; // the program that reads them does not answer

/** For people. */
export const sinkFaultWords: Readonly<Record<SinkFault, string>> = {
  starting: 'the connection to the wheels is being opened',
  'thread-ended': 'velocities cannot be published: trying again',
  'thread-hung': 'the thread that publishes velocities hangs',
  'no-listener': 'nobody listens to the velocities',
  'write-failed': 'velocities cannot be written',
  'reader-silent': 'the program that reads the velocities does not answer',
};

/**
 * Moves the wheels. It gets what the drive guard has let through: velocities within the limits, and zero on silence.
 * The same velocity is sent repeatedly. A sink that receives nothing for the watchdog's time must stop by itself.
 */
export interface VelocitySink {
  readonly kind: string;
  /** Why nothing takes velocities now; `null` or undefined if something does, as far as is known. */
  readonly fault?: SinkFault | null;
  /** How often a part of it was restarted after a fault. */
  readonly restarts?: number;
  /** @param estop whether the emergency stop is latched: other drivers of the same wheels must then stand still, too */
  apply(twist: Twist, estop: boolean): void;
  /** Sets the listener for what people should know about the wheels. */
  tellReadings?(listener: (reading: TopicReading) => void): void;
  /** Stops the wheels and releases resources. */
  close(): void | Promise<void>;
}
