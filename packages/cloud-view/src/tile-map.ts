/**
 * Which frame each tile of a surface shows. No GPU here: indices only.
 *
 * A tile stays until one of a newer frame replaces it, so a lost packet shows its place a little older and never leaves
 * a hole. Each of the last {@link FRAME_SLOTS} frames has a *slot*, under which the shader finds its pose.
 */
import { sequenceDelta32 } from '@farpoint/protocol';

/**
 * Number of frames whose tiles can be shown at once. Chosen: two seconds at 30 a second, twice as long as a
 * tile may stay.
 */
export const FRAME_SLOTS = 64;
/** Stands for the slot of a tile that is not shown. */
export const HIDDEN = 255;
/**
 * A tile is hidden when it is older than the newest frame by this time … Chosen: what has moved on within a
 * second is somewhere else (docs/drawing.md).
 */
const STALE_MS = 1000;
/** … and by more than this number of frames. */
const STALE_FRAMES = 3;

export class TileMap {
  /** The slot of the frame that each tile shows, or {@link HIDDEN}. */
  readonly slots: Uint8Array;
  /** The slot of the newest frame. */
  newestSlot = 0;
  newestFrame: number | null = null;
  /** Progress of the newest frame, 0–1: the end of its furthest packet. */
  progress = 0;
  /** Number of tiles that are shown. */
  shown = 0;
  /** How many frames have begun. The n-th frame's slot is n modulo {@link FRAME_SLOTS}. */
  #begun = 0;
  #previousFrame: number | null = null;
  readonly #frames = new Float64Array(FRAME_SLOTS);
  readonly #beganMs = new Float64Array(FRAME_SLOTS);
  /** Points of each slot's frame that have not come. */
  readonly #missing = new Float64Array(FRAME_SLOTS);
  /** Which frame each tile has, counted as `#begun` does; 0 for none. */
  readonly #shows: Uint32Array;

  /** @param tiles number of tiles of the image */
  constructor(tiles: number) {
    this.slots = new Uint8Array(tiles).fill(HIDDEN);
    this.#shows = new Uint32Array(tiles);
  }

  /** The newest frame that has ended, like that of a window of points. */
  get endedFrame(): number | null {
    return this.progress >= 1 ? this.newestFrame : this.#previousFrame;
  }

  /** When a slot's frame began to arrive, on the clock of {@link open}. */
  beganMs(slot: number): number {
    return this.#beganMs[slot] as number;
  }

  /** Forgets everything. */
  reset(): void {
    this.slots.fill(HIDDEN);
    this.#shows.fill(0);
    this.newestFrame = null;
    this.#previousFrame = null;
    this.progress = 0;
    this.shown = 0;
    this.#begun = 0;
  }

  /**
   * The slot of a frame that a packet belongs to; a frame newer than the newest begins. `null`: the frame is too old.
   *
   * @param frame its number; wraps at 2³²
   * @param end share of the frame at which the packet ends, 0–1
   */
  open(frame: number, end: number, nowMs: number): number | null {
    const delta = this.newestFrame === null ? 1 : sequenceDelta32(frame, this.newestFrame);
    if (delta > 0) this.#begin(frame, nowMs);
    if (delta >= 0) {
      this.progress = Math.max(this.progress, end);
      return this.newestSlot;
    }
    const oldest = Math.max(this.#begun - FRAME_SLOTS + 1, 1);
    for (let n = this.#begun - 1; n >= oldest; n--) {
      if (this.#frames[n % FRAME_SLOTS] === frame) return n % FRAME_SLOTS;
    }
    return null;
  }

  /**
   * Shows a tile of the frame in a slot, unless it shows a newer one.
   *
   * @param empty nothing was seen there: the tile is hidden
   * @returns whether the tile's samples are to be written
   */
  show(tile: number, slot: number, empty: boolean): boolean {
    const count = this.#countOf(slot);
    if ((this.#shows[tile] as number) > count) return false;
    this.#shows[tile] = count;
    this.#set(tile, empty ? HIDDEN : slot);
    return true;
  }

  /**
   * Counts a packet's points, after its tiles were shown. Once all of a frame's points have come, tiles that it did not
   * have are empty, and are hidden.
   *
   * @param points the packet's
   * @param total the frame's
   */
  count(slot: number, points: number, total: number): void {
    const before = this.#missing[slot] as number;
    const missing = (before < 0 ? total : before) - points;
    this.#missing[slot] = Math.max(missing, 0);
    if (missing > 0) return;
    const count = this.#countOf(slot);
    for (let tile = 0; tile < this.slots.length; tile++) {
      if ((this.#shows[tile] as number) < count) this.#set(tile, HIDDEN);
    }
  }

  /** How many frames had begun with a slot's. */
  #countOf(slot: number): number {
    return this.#begun - ((this.newestSlot - slot + FRAME_SLOTS) % FRAME_SLOTS);
  }

  #begin(frame: number, nowMs: number): void {
    this.#previousFrame = this.newestFrame;
    this.newestFrame = frame;
    this.progress = 0;
    this.#begun++;
    this.newestSlot = this.#begun % FRAME_SLOTS;
    this.#frames[this.newestSlot] = frame;
    this.#missing[this.newestSlot] = -1;
    this.#beganMs[this.newestSlot] = nowMs;
    this.#hideStale(nowMs);
  }

  #hideStale(nowMs: number): void {
    const { slots } = this;
    for (let tile = 0; tile < slots.length; tile++) {
      const slot = slots[tile] as number;
      if (slot === HIDDEN) continue;
      const behind = this.#begun - (this.#shows[tile] as number);
      const reused = behind >= FRAME_SLOTS;
      if (reused || (behind > STALE_FRAMES && nowMs - this.beganMs(slot) > STALE_MS)) this.#set(tile, HIDDEN);
    }
  }

  #set(tile: number, slot: number): void {
    this.shown += Number(slot !== HIDDEN) - Number(this.slots[tile] !== HIDDEN);
    this.slots[tile] = slot;
  }
}
