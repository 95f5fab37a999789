import type { Twist } from '@farpoint/protocol';
import type { TopicReading } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import { ReferenceControlWriter, type TrustedOwner } from '@farpoint/shared-memory';
import { monotonicMs } from '../../ground/clock.ts';
import type { SinkFault, VelocitySink } from '../../ground/velocity-sink.ts';
import { ReaderWatch } from './reader-watch.ts';
import type { RosDriveOptions } from './ros-drive-messages.ts';
import { RosSink } from './ros-sink.ts';
import { wheelsReading } from './wheels-reading.ts';

const BLOCK = 'shared_control';

/** Writes the command block. A native thread sets it to zero when this process's threads hang. */
class SharedMemorySink implements VelocitySink {
  readonly kind = 'shm';
  readonly #writer: ReferenceControlWriter;
  readonly #log: Logger;
  readonly #now: () => number;
  readonly #reader: ReaderWatch;
  #counter: number | null = null;
  #failing = false;
  #told: SinkFault | null = null;
  #onReading: ((reading: TopicReading) => void) | null = null;

  /** @param readerRequired whether motion needs a reader that answers, even if none ever has */
  constructor(writer: ReferenceControlWriter, log: Logger, readerRequired = false, now = monotonicMs) {
    this.#writer = writer;
    this.#log = log;
    this.#now = now;
    this.#reader = new ReaderWatch(readerRequired);
  }

  get fault(): SinkFault | null {
    if (this.#failing) return 'write-failed';
    return this.#reader.isSilent(this.#now()) ? 'reader-silent' : null;
  }

  /** Reports whether velocities can be written, and whether the program that reads them answers. */
  tellReadings(listener: (reading: TopicReading) => void): void {
    this.#onReading = listener;
    if (this.#told !== null) this.#tell(this.#told);
  }

  apply(twist: Twist): void {
    try {
      if (this.#counter !== null) this.#reader.note(this.#writer.readerEcho(), this.#counter, this.#now());
      this.#counter = this.#writer.write(twist);
      this.#failing = false;
    } catch (error) {
      // The next beat retries. Whatever reads the block stops when its counter stands still.
      if (!this.#failing) this.#log.error({ err: error }, 'the velocity could not be written');
      this.#failing = true;
    }
    const { fault } = this;
    if (fault !== this.#told) this.#tell(fault);
  }

  close(): void {
    this.#writer.close();
  }

  #tell(fault: SinkFault | null): void {
    if (fault !== this.#told) {
      if (fault === 'reader-silent') this.#log.error('the program that reads the velocities does not answer');
      else if (fault === null) this.#log.info('the wheels take velocities again');
    }
    this.#told = fault;
    this.#onReading?.(wheelsReading(BLOCK, fault, 'written'));
  }
}

export type SinkOptions =
  /** The simulated base if there is one; otherwise nothing moves. */
  | { kind: 'base' }
  /** The reference system's command block in shared memory. */
  | {
      kind: 'shm';
      folder: string;
      owner?: TrustedOwner | undefined;
      mode: number;
      silenceMs: number;
      readerRequired?: boolean;
    }
  /** A topic of a ROS graph. */
  | ({ kind: 'ros' } & RosDriveOptions);

/** @throws {Error} saying what is missing */
export function openSink(options: SinkOptions, base: VelocitySink | null, log: Logger): VelocitySink {
  switch (options.kind) {
    case 'base':
      return base ?? { kind: 'none', apply: () => undefined, close: () => undefined };
    case 'shm':
      return new SharedMemorySink(new ReferenceControlWriter(options), log, options.readerRequired);
    case 'ros':
      return new RosSink(options, log);
  }
}
