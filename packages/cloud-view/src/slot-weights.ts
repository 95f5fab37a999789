/** How much of its own picture each frame's slot of a surface shows, so that colours do not jump. Time is an argument. */
import { FRAME_SLOTS } from './tile-map.ts';

/**
 * A picture that comes after its frame appears within this time, and one that is switched off disappears, ms.
 * Chosen by eye: at once it flickers (docs/cameras.md); slot-weights.test.ts holds it.
 */
const BLEND_MS = 150;

export class SlotWeights {
  /** For each slot: 0, the packets' own colours; up to 1, the picture's. */
  readonly weights = new Float32Array(FRAME_SLOTS);
  #updatedMs = 0;

  /** A slot's frame begins. @param has whether its picture is there: then it is shown at once */
  begin(slot: number, has: boolean): void {
    this.weights[slot] = Number(has);
  }

  /** Goes on to this time. @param layerOf the layer of a slot's picture; `null`: it has none, or shall not show it */
  update(nowMs: number, on: boolean, layerOf: (slot: number) => number | null): void {
    const step = Math.min(Math.max(nowMs - this.#updatedMs, 0) / BLEND_MS, 1);
    this.#updatedMs = nowMs;
    for (let slot = 0; slot < FRAME_SLOTS; slot++) {
      const before = this.weights[slot] as number;
      // Of a picture that is gone nothing can be shown.
      if (layerOf(slot) === null) this.weights[slot] = 0;
      else this.weights[slot] = on ? Math.min(before + step, 1) : Math.max(before - step, 0);
    }
  }

  clear(): void {
    this.weights.fill(0);
  }
}
