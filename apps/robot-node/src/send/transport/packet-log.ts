import { ColumnLog } from '../../ground/column-log.ts';

/** Number of packets kept: half a minute at 40 Mbit/s. */
const DEFAULT_CAPACITY = 131_072;

/**
 * Records when each of the latest packets left. Joined with the receiver's log by frame and offset, it gives the
 * delivery time of every packet.
 */
export class PacketLog extends ColumnLog {
  constructor(path: string, capacity = DEFAULT_CAPACITY) {
    super(path, ['frameNumber', 'sequenceOffset', 'sentMs'], capacity);
  }

  /** @param sentMs on the robot's monotonic clock */
  add(frameNumber: number, sequenceOffset: number, sentMs: number): void {
    this.addRow(frameNumber, sequenceOffset, sentMs);
  }
}
