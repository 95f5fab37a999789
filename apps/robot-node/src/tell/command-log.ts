import type { Command } from '@farpoint/protocol';
import { ColumnLog } from '../ground/column-log.ts';

/** Number of commands kept: 20 minutes at 50 a second. */
const DEFAULT_CAPACITY = 60_000;

/**
 * Records when each of the latest commands was sent and received. On one machine, or with clocks in step, that is how
 * long it took.
 */
export class CommandLog extends ColumnLog {
  constructor(path: string, capacity = DEFAULT_CAPACITY) {
    super(path, ['sequence', 'sentMs', 'receivedMs', 'accepted'], capacity);
  }

  /** @param receivedMs on the robot's clock; the command's own time is on its sender's */
  add({ sequence, timeMs }: Command, accepted: boolean, receivedMs: number): void {
    this.addRow(sequence, timeMs, receivedMs, accepted ? 1 : 0);
  }
}
