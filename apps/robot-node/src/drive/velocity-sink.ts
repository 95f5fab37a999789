import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';

/**
 * What moves the wheels. It gets what the drive guard has let through: within the limits, and zero on silence. The same
 * velocity comes again and again; a sink that hears nothing for the watchdog's time must stop by itself.
 */
export interface VelocitySink {
  readonly kind: string;
  /** @param estop whether the emergency stop is latched: others who drive the same wheels are to stand still, too */
  apply(twist: Twist, estop: boolean): void;
  /** Tells from now on what people should know of the wheels. */
  tellReadings?(listener: (reading: TopicReading) => void): void;
  /** Stops and lets go. */
  close(): void | Promise<void>;
}
