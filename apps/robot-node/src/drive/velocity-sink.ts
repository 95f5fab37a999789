import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';

/**
 * Moves the wheels. It gets what the drive guard has let through: velocities within the limits, and zero on silence.
 * The same velocity is sent repeatedly. A sink that receives nothing for the watchdog's time must stop by itself.
 */
export interface VelocitySink {
  readonly kind: string;
  /** @param estop whether the emergency stop is latched: other drivers of the same wheels must then stand still, too */
  apply(twist: Twist, estop: boolean): void;
  /** Sets the listener for what people should know about the wheels. */
  tellReadings?(listener: (reading: TopicReading) => void): void;
  /** Stops the wheels and releases resources. */
  close(): void | Promise<void>;
}
