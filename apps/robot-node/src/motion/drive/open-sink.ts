import type { Logger } from '@farpoint/service';
import { ReferenceControlWriter, type TrustedOwner } from '@farpoint/shared-memory';
import type { VelocitySink } from '../../ground/velocity-sink.ts';
import type { RosDriveOptions } from './ros-drive-messages.ts';
import { RosSink } from './ros-sink.ts';
import { SharedMemorySink } from './shm-sink.ts';

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
