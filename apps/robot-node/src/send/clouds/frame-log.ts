import { ColumnLog } from '../../ground/column-log.ts';
import type { ReadyFrame } from '../../sense/capture/capture-messages.ts';

/** Number of frames kept: ten minutes at 30 frames/s. */
const DEFAULT_CAPACITY = 18_000;

/**
 * Records when each of the latest frames was captured and when its packets were ready. Joined with a camera producer's
 * log, it gives the time from the camera to the first packet.
 */
export class FrameLog extends ColumnLog {
  constructor(path: string, capacity = DEFAULT_CAPACITY) {
    super(path, ['frameNumber', 'capturedMs', 'readyMs', 'points'], capacity);
  }

  add({ frameNumber, capturedAtMs, readyMs, points }: ReadyFrame): void {
    this.addRow(frameNumber, capturedAtMs, readyMs, points);
  }
}
