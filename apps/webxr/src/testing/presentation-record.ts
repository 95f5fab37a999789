/** Records what videos show, for measurements: the time that is drawn in each picture, and when it was on the screen. */
import { BARCODE_HEIGHT, BARCODE_WIDTH, msOfBarcodeTime, readBarcode } from '@farpoint/protocol';

export interface PresentationRow {
  /** `null` until the display frame is finished. */
  finishedMs: number | null;
  /** By video; `null` where no barcode can be read. */
  drawnMs: (number | null)[];
  /** When the newest cloud beside them was captured; `null` without one. */
  cloudMs: number | null;
}

export class PresentationRecord {
  readonly rows: PresentationRow[] = [];
  readonly #capacity: number;
  readonly #robotNowMs: () => number | null;

  constructor(capacity: number, robotNowMs: () => number | null) {
    this.#capacity = capacity;
    this.#robotNowMs = robotNowMs;
  }

  /** Reads the canvases now; the display frame that shows them ends before the next one begins. */
  add(canvases: readonly HTMLCanvasElement[], cloudMs: () => number | null): void {
    if (this.rows.length >= this.#capacity) return;
    const row: PresentationRow = { finishedMs: null, drawnMs: canvases.map(readTime), cloudMs: null };
    this.rows.push(row);
    // Clouds follow the videos in the same display frame.
    queueMicrotask(() => {
      row.cloudMs = cloudMs();
    });
    requestAnimationFrame(() => {
      row.finishedMs = this.#robotNowMs();
    });
  }
}

function readTime(canvas: HTMLCanvasElement): number | null {
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (context === null || canvas.width < BARCODE_WIDTH || canvas.height < BARCODE_HEIGHT) return null;
  const { data } = context.getImageData(0, 0, BARCODE_WIDTH, BARCODE_HEIGHT);
  const { time } = readBarcode(data, BARCODE_WIDTH, BARCODE_HEIGHT, BARCODE_WIDTH * 4, 4);
  return time === null ? null : msOfBarcodeTime(time);
}
