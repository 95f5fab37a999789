import type { Twist } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import type { ReferenceControlWriter } from '@farpoint/shared-memory';
import type { VelocitySink } from './velocity-sink.ts';

/** Writes the command block. A native thread sets it to zero when this process's threads hang. */
export class SharedMemorySink implements VelocitySink {
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
      // The next beat retries. Whatever reads the block stops when its counter stands still.
      if (!this.#failing) this.#log.error({ err: error }, 'the velocity could not be written');
      this.#failing = true;
    }
  }

  close(): void {
    this.#writer.close();
  }
}
