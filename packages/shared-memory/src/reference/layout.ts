/** The reference system's four files. Little-endian; offsets are not aligned. */
import { join } from 'node:path';
import { pointsOfBytes } from '@farpoint/protocol';

export const DEFAULT_FOLDER = '/dev/shm';

/** Maximum length of packed points: 480 × 480 points of 8 bytes. */
export const MAX_PAYLOAD_BYTES = 1_843_200;
export const MAX_POINTS = pointsOfBytes(MAX_PAYLOAD_BYTES);

/** `shared_pc`: the payload's length in three bytes, then the payload. */
export const LENGTH_BYTES = 3;
export const CLOUD_BYTES = LENGTH_BYTES + MAX_PAYLOAD_BYTES;

/** `semaphore_read`. */
export const FLAG_BYTES = 6;
export const READY_OFFSET = 0;
export const LATENCY_OFFSET = 1;
export const BITRATE_OFFSET = 2;

/** `shared_control`: counter (i32), then linear x, y, z and angular x, y, z (f64). */
export const CONTROL_BYTES = 52;
/**
 * `semaphore_ros_read`: byte 0 is 1 while the block is written. In byte 1, which the reference system leaves alone, a
 * reader repeats the lowest byte of the counter that it has acted on.
 */
export const BUSY_BYTES = 5;
export const ECHO_OFFSET = 1;

export interface ReferenceFiles {
  cloud: string;
  flags: string;
  control: string;
  busy: string;
}

export function referenceFiles(folder = DEFAULT_FOLDER): ReferenceFiles {
  return {
    cloud: join(folder, 'shared_pc'),
    flags: join(folder, 'semaphore_read'),
    control: join(folder, 'shared_control'),
    busy: join(folder, 'semaphore_ros_read'),
  };
}
