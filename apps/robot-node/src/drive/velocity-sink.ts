import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import { ReferenceControlWriter } from '@farpoint/shared-memory';
import type { RosDriveOptions } from './ros-drive-messages.ts';
import { RosSink } from './ros-sink.ts';

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

export type SinkOptions =
  /** The source's own wheels: the simulator's. */
  | { kind: 'source' }
  /** The reference system's command block in shared memory. */
  | { kind: 'shm'; folder: string; mode: number; silenceMs: number }
  /** A topic of a ROS graph. */
  | ({ kind: 'ros' } & RosDriveOptions);

/** @throws {Error} saying what is missing */
export function openSink(
  options: SinkOptions,
  source: { setTwist(twist: Twist): void },
  log: Logger,
): VelocitySink {
  switch (options.kind) {
    case 'source':
      return { kind: 'source', apply: (twist) => source.setTwist(twist), close: () => undefined };
    case 'shm':
      return new SharedMemorySink(new ReferenceControlWriter(options), log);
    case 'ros':
      return new RosSink(options, log);
  }
}

/** Writes the command block; a native thread makes it zero where this process's threads hang. */
class SharedMemorySink implements VelocitySink {
  readonly kind = 'shm';
  readonly #writer: ReferenceControlWriter;
  readonly #log: Logger;
  #failing = false;

  constructor(writer: ReferenceControlWriter, log: Logger) {
    this.#writer = writer;
    this.#log = log;
  }

  apply(twist: Twist): void {
    try {
      this.#writer.write(twist);
      this.#failing = false;
    } catch (error) {
      // It is tried again with the next beat; what reads the block stops once its counter stands still.
      if (!this.#failing) this.#log.error({ err: error }, 'the velocity could not be written');
      this.#failing = true;
    }
  }

  close(): void {
    this.#writer.close();
  }
}
