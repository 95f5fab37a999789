/** What a battery's messages say, as far as it can be believed. */
import type { Battery } from '@farpoint/protocol';
import { batteryStateSchema } from './messages.ts';

/** A full battery may be told as a little more than 1. */
const MOST_SHARE = 1.01;
const PERCENT = 100;

export interface GaugeReading {
  /** Volts; `null` if unknown. */
  voltage: number | null;
  /** Of a full charge, 0 to 1; `null` if unknown. */
  share: number | null;
}

/**
 * One battery's gauge. sensor_msgs/BatteryState tells the charge from 0 to 1, and NaN if it is unknown. Some drivers tell
 * it from 0 to 100: what does so once does so always, and then 0.9 is an empty battery, not a full one.
 */
export class BatteryGauge {
  #inPercent = false;
  #said = false;

  /** Whether the charge is told from 0 to 100. */
  get inPercent(): boolean {
    return this.#inPercent;
  }

  /** What people should know of this gauge, once; else `null`. */
  get warning(): string | null {
    if (!this.#inPercent || this.#said) return null;
    this.#said = true;
    return 'the battery tells its charge from 0 to 100, not from 0 to 1 as sensor_msgs/BatteryState says: it is read as percent';
  }

  /** @throws {Error} if the message does not match its type */
  read(message: unknown): GaugeReading {
    const { voltage, percentage } = batteryStateSchema.parse(message);
    if (percentage > MOST_SHARE && percentage <= PERCENT * MOST_SHARE) this.#inPercent = true;
    const share = this.#inPercent ? percentage / PERCENT : percentage;
    return {
      voltage: voltage >= 0 && voltage < Number.POSITIVE_INFINITY ? voltage : null,
      // Negative or NaN: not measured.
      share: share >= 0 && share <= MOST_SHARE ? Math.min(share, 1) : null,
    };
  }

  /** As it is told to operators; `null` if nothing of it is known. @throws {Error} if the message does not match its type */
  battery(message: unknown): Battery | null {
    const { voltage, share } = this.read(message);
    if (voltage === null && share === null) return null;
    return {
      ...(voltage === null ? {} : { voltage }),
      ...(share === null ? {} : { percentage: share }),
    };
  }
}
