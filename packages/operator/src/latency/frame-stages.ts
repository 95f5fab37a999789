/** Where the time of a cloud goes, stage by stage. The stages of a frame add up to its latency. No clock here. */

/** Means over the last frames, ms. */
export interface FrameStages {
  /** How many frames they are of. */
  frames: number;
  /** Frames since the session began: it stands still when no cloud comes any more, and so do the means. */
  framesSeen: number;
  /** Capture to the arrival of the frame's first packet: what the robot and the network take together. */
  firstPacketMs: number;
  /** Arrival of the first packet to that of the last one. */
  furtherPacketsMs: number;
  /** Arrival of the last packet to the end of the display frame that shows it. */
  drawMs: number;
  /** Capture to the end of that display frame: the sum of the stages. */
  totalMs: number;
}

const KEPT = 64;

/** The stages of the last frames. Adding allocates nothing. */
export class FrameStageWindow {
  readonly #first = new Float64Array(KEPT);
  readonly #further = new Float64Array(KEPT);
  readonly #draw = new Float64Array(KEPT);
  #count = 0;

  /** Adds a frame, in place of the oldest if the window is full. Times are in ms. */
  add(firstPacketMs: number, furtherPacketsMs: number, drawMs: number): void {
    const at = this.#count++ % KEPT;
    this.#first[at] = firstPacketMs;
    this.#further[at] = furtherPacketsMs;
    this.#draw[at] = drawMs;
  }

  /** Forgets all frames. */
  clear(): void {
    this.#count = 0;
  }

  /** `null` before the first frame. */
  means(): FrameStages | null {
    const frames = Math.min(this.#count, KEPT);
    if (frames === 0) return null;
    const [firstPacketMs, furtherPacketsMs, drawMs] = [this.#first, this.#further, this.#draw].map((kept) =>
      meanOf(kept, frames),
    ) as [number, number, number];
    return {
      ...{ frames, framesSeen: this.#count, firstPacketMs, furtherPacketsMs, drawMs },
      totalMs: firstPacketMs + furtherPacketsMs + drawMs,
    };
  }
}

function meanOf(kept: Float64Array, count: number): number {
  let sum = 0;
  for (let i = 0; i < count; i++) sum += kept[i] as number;
  return sum / count;
}
