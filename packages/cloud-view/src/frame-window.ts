/**
 * Which received points are drawn, and where they lie in the ring of vertices. No GPU here: indices only.
 *
 * All received points of the newest frame are drawn, and those points of the frame before it whose place in the frame
 * (sequenceOffset ÷ frameLength) lies beyond the newest frame's progress. The picture is therefore whole while a frame
 * arrives bit by bit, a lost packet leaves a hole for one frame, and nothing waits for a last packet or the next frame.
 *
 * Packets are appended to the ring as they arrive. A *run* is a stretch of the ring with packets of one frame in
 * ascending order. Its front is hidden packet by packet as the next frame replaces it. The drawn vertices lie between
 * {@link head} and {@link tail}; the runs describe hidden stretches among them, which out-of-order packets cause.
 */
import { pointsOfBytes, sequenceDelta32 } from '@farpoint/protocol';

/**
 * Runs of one frame's points that the shader knows. Chosen: a second at 30 a second; each is a vector of
 * uniforms, of which WebGL 2 has 256 in a vertex shader.
 */
export const MAX_RUNS = 32;
/** int32 fields of a run in {@link FrameWindow.runs}: first vertex, first visible vertex, pose slot, unused. */
export const RUN_FIELDS = 4;

/** Why a packet is not drawn. */
export type WindowDrop =
  | 'late' // of a frame before the previous one
  | 'superseded' // of the previous frame, at a place that the newest has passed
  | 'window-full'; // more packets or runs than there is room for

/** The live part of the ring must move to the ring's front, in a larger ring if `capacity` has grown. */
export interface Relocation {
  from: number;
  count: number;
  capacity: number;
}

/** Number of runs that out-of-order packets may not use. Chosen: the newest frames come in meanwhile. */
const RUNS_KEPT = 3;
/** Packets of the window that can be remembered: a power of two, so that a place is found with a mask. */
const ENTRIES = 65_536;
const ENTRY_MASK = ENTRIES - 1;

export class FrameWindow {
  /** Size of the ring, vertices. */
  capacity: number;
  readonly maxCapacity: number;
  /** The first vertex to draw, and one past the last. */
  head = 0;
  tail = 0;
  /** Runs in ring order, {@link RUN_FIELDS} each, as in the shader's uniform. */
  readonly runs = new Int32Array(MAX_RUNS * RUN_FIELDS);
  runCount = 0;
  newestFrame: number | null = null;
  previousFrame: number | null = null;
  /** Which pose (0 or 1) the newest frame has; the previous frame has the other. */
  newestSlot = 0;
  /** Number of points of the whole newest frame. */
  newestTotal = 0;
  /** Progress of the newest frame, 0–1: the end of its furthest packet. */
  progress = 0;

  // One entry per packet, in ring order. Entry numbers only grow; the arrays are rings.
  readonly #entryStart = new Int32Array(ENTRIES);
  readonly #entryPlace = new Float64Array(ENTRIES);
  #firstEntry = 0;
  #endEntry = 0;
  /** For each run: its first entry, the first entry of its visible part, and the place where its last packet ended. */
  readonly #runFirstEntry = new Float64Array(MAX_RUNS);
  readonly #runEntry = new Float64Array(MAX_RUNS);
  readonly #runPlace = new Float64Array(MAX_RUNS);

  /** @param capacity initial size, vertices; grows up to `maxCapacity` as frames need it */
  constructor(capacity: number, maxCapacity: number) {
    this.capacity = capacity;
    this.maxCapacity = maxCapacity;
  }

  /**
   * The newest frame that has ended: its last packet has arrived, or a newer frame has overtaken it. Some of its
   * packets may be lost.
   */
  get endedFrame(): number | null {
    return this.progress >= 1 ? this.newestFrame : this.previousFrame;
  }

  /** Forgets everything: in a new session frame numbers restart. */
  reset(): void {
    this.head = 0;
    this.tail = 0;
    this.runCount = 0;
    this.newestFrame = null;
    this.previousFrame = null;
    this.newestTotal = 0;
    this.progress = 0;
    this.#firstEntry = 0;
    this.#endEntry = 0;
  }

  /**
   * Makes room for `points` more vertices at the tail. The caller must carry out the returned move before the next
   * {@link accept}; the window already assumes it.
   *
   * @param points at most half the largest capacity
   */
  reserve(points: number): Relocation | null {
    if (this.tail + points <= this.capacity) return null;
    const count = this.tail - this.head;
    const from = this.head;
    // At most half full after the move; otherwise it would move at every batch, and onto itself.
    while ((count + points) * 2 > this.capacity && this.capacity < this.maxCapacity) {
      this.capacity = Math.min(this.capacity * 2, this.maxCapacity);
    }
    if ((count + points) * 2 > this.capacity) {
      // More than the largest ring holds: start over.
      this.reset();
      return { from: 0, count: 0, capacity: this.capacity };
    }
    for (let entry = this.#firstEntry; entry < this.#endEntry; entry++) {
      const i = entry & ENTRY_MASK;
      this.#entryStart[i] = (this.#entryStart[i] as number) - from;
    }
    for (let run = 0; run < this.runCount; run++) {
      this.#setRun(run, Math.max(0, this.#runStart(run) - from), this.#runVisible(run) - from);
    }
    this.head = 0;
    this.tail = count;
    return { from, count, capacity: this.capacity };
  }

  /**
   * Takes one packet whose `points` vertices will be written at {@link tail} (its value before the call).
   *
   * @param sequenceLength bytes of the frame that it carries, 8 per point; there may be fewer vertices
   * @returns why it is not drawn, or `null` if it is: the tail has then advanced
   */
  accept(
    frameNumber: number,
    frameLength: number,
    sequenceOffset: number,
    sequenceLength: number,
    points = pointsOfBytes(sequenceLength),
  ): WindowDrop | null {
    const place = sequenceOffset / frameLength;
    const isPrevious = this.newestFrame !== null && sequenceDelta32(frameNumber, this.newestFrame) < 0;
    if (isPrevious) {
      if (frameNumber !== this.previousFrame) return 'late';
      if (place < this.progress) return 'superseded';
    }
    if (this.#endEntry - this.#firstEntry >= ENTRIES) return 'window-full';
    if (!isPrevious && frameNumber !== this.newestFrame) this.#beginFrame(frameNumber, frameLength);
    const slot = isPrevious ? 1 - this.newestSlot : this.newestSlot;
    if (!this.#extendOrOpenRun(slot, place, isPrevious)) return 'window-full';

    const i = this.#endEntry++ & ENTRY_MASK;
    this.#entryStart[i] = this.tail;
    this.#entryPlace[i] = place;
    this.tail += points;
    const end = (sequenceOffset + sequenceLength) / frameLength;
    this.#runPlace[this.runCount - 1] = end;
    if (!isPrevious) {
      if (end > this.progress) {
        this.progress = end;
        this.#hideReplaced();
      }
    }
    return null;
  }

  /** The pose slot with which a vertex between head and tail is drawn, as in the shader; `null` if it is hidden. */
  slotOf(vertex: number): number | null {
    for (let run = this.runCount - 1; run >= 0; run--) {
      if (vertex < this.#runStart(run)) continue;
      return vertex >= this.#runVisible(run) ? this.#runSlot(run) : null;
    }
    return null;
  }

  #beginFrame(frameNumber: number, frameLength: number): void {
    // The rest of the previous frame was never replaced because of lost packets: hide it now.
    const oldSlot = 1 - this.newestSlot;
    for (let run = 0; run < this.runCount; run++) {
      if (this.#runSlot(run) === oldSlot) this.#hideRun(run);
    }
    this.previousFrame = this.newestFrame;
    this.newestFrame = frameNumber;
    this.newestSlot = oldSlot;
    this.newestTotal = pointsOfBytes(frameLength);
    this.progress = 0;
    this.#dropHiddenFront();
  }

  #extendOrOpenRun(slot: number, place: number, isPrevious: boolean): boolean {
    const last = this.runCount - 1;
    const sameFrame = last >= 0 && this.#runSlot(last) === slot;
    if (sameFrame && (this.#runPlace[last] as number) <= place) return true;
    // The last runs are reserved, so that the newest frame can always continue and the next can begin. A packet that is
    // out of order within its frame and gets no run is only replaced a little late or early.
    const isReordered = sameFrame || isPrevious;
    if (isReordered && this.runCount >= MAX_RUNS - RUNS_KEPT) return sameFrame;
    if (this.runCount === MAX_RUNS) return false;
    const run = this.runCount++;
    this.#setRun(run, this.tail, this.tail);
    this.runs[run * RUN_FIELDS + 2] = slot;
    this.#runFirstEntry[run] = this.#endEntry;
    this.#runEntry[run] = this.#endEntry;
    return true;
  }

  /** Hides the front of the previous frame's runs, up to the newest frame's progress. */
  #hideReplaced(): void {
    const slot = 1 - this.newestSlot;
    let moved = false;
    for (let run = 0; run < this.runCount; run++) {
      if (this.#runSlot(run) !== slot) continue;
      const end = this.#endEntryOf(run);
      let entry = this.#runEntry[run] as number;
      const before = entry;
      while (entry < end && (this.#entryPlace[entry & ENTRY_MASK] as number) < this.progress) entry++;
      if (entry === before) continue;
      this.#runEntry[run] = entry;
      this.#setRun(run, this.#runStart(run), this.#startOf(entry));
      moved = true;
    }
    if (moved) this.#dropHiddenFront();
  }

  #hideRun(run: number): void {
    const end = this.#endEntryOf(run);
    this.#runEntry[run] = end;
    this.#setRun(run, this.#runStart(run), this.#startOf(end));
  }

  /** Removes completely hidden runs at the front, and moves the head to the first visible vertex. */
  #dropHiddenFront(): void {
    let gone = 0;
    while (gone < this.runCount && this.#runEntry[gone] === this.#endEntryOf(gone)) gone++;
    if (gone > 0) {
      this.runs.copyWithin(0, gone * RUN_FIELDS, this.runCount * RUN_FIELDS);
      this.#runFirstEntry.copyWithin(0, gone, this.runCount);
      this.#runEntry.copyWithin(0, gone, this.runCount);
      this.#runPlace.copyWithin(0, gone, this.runCount);
      this.runCount -= gone;
    }
    this.#firstEntry = this.runCount === 0 ? this.#endEntry : (this.#runEntry[0] as number);
    this.head = this.runCount === 0 ? this.tail : this.#runVisible(0);
  }

  #endEntryOf(run: number): number {
    return run + 1 === this.runCount ? this.#endEntry : (this.#runFirstEntry[run + 1] as number);
  }

  #startOf(entry: number): number {
    return entry === this.#endEntry ? this.tail : (this.#entryStart[entry & ENTRY_MASK] as number);
  }

  #runStart(run: number): number {
    return this.runs[run * RUN_FIELDS] as number;
  }
  #runVisible(run: number): number {
    return this.runs[run * RUN_FIELDS + 1] as number;
  }
  #runSlot(run: number): number {
    return this.runs[run * RUN_FIELDS + 2] as number;
  }
  #setRun(run: number, start: number, visible: number): void {
    this.runs[run * RUN_FIELDS] = start;
    this.runs[run * RUN_FIELDS + 1] = visible;
  }
}
