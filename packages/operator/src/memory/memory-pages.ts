/**
 * Changed pages on their way from the memory to whoever draws them, in one buffer that is transferred and returned.
 *
 *     0    32 bytes for each page, i32: number of the page, surfels, x, y, z of its chunk, the oldest age unit, 2 unused
 *   2048   2048 bytes for each page: u32 ×2 for each confirmed surfel: its place in its chunk (memory-layout.ts); its colour,
 *          5-6-5 bits, and, from bit 16 on, when it was last seen, in units of age
 */
import { ageUnits, PAGE_SURFELS } from './memory-layout.ts';
import type { SurfelStore } from './surfel-store.ts';

/** The most pages of a buffer. */
export const BUFFER_PAGES = 64;
const HEADER_WORDS = 8;
const SURFELS_AT = BUFFER_PAGES * HEADER_WORDS;
/** Words of a page's surfels. */
export const PAGE_WORDS = PAGE_SURFELS * 2;
export const PAGES_BYTES = (SURFELS_AT + BUFFER_PAGES * PAGE_WORDS) * 4;

/** Changed pages of what is remembered: surfels of one chunk each, packed as the GPU takes them. */
export class MemoryPages {
  /** The memory behind all views. */
  readonly buffer: ArrayBuffer;
  /** All words of the buffer; those of a page's surfels begin at {@link surfelsAt}. */
  readonly words: Uint32Array;
  /** Number of pages. */
  count: number;
  readonly #headers: Int32Array;

  /** @param buffer {@link PAGES_BYTES} long @param count number of pages that it holds */
  constructor(buffer: ArrayBuffer, count = 0) {
    this.buffer = buffer;
    this.words = new Uint32Array(buffer);
    this.#headers = new Int32Array(buffer, 0, SURFELS_AT);
    this.count = count;
  }

  /** Number of the page: what came earlier under this number is no longer true. */
  page(index: number): number {
    return this.#headers[index * HEADER_WORDS] as number;
  }
  /** Number of the page's surfels; 0: it is empty now. */
  surfels(index: number): number {
    return this.#headers[index * HEADER_WORDS + 1] as number;
  }
  /** Coordinate of the page's chunk, in chunks. @param axis 0–2: x, y, z */
  chunk(index: number, axis: number): number {
    return this.#headers[index * HEADER_WORDS + 2 + axis] as number;
  }
  /** When the surfel that was seen least recently was seen, in units of age. */
  oldest(index: number): number {
    return this.#headers[index * HEADER_WORDS + 5] as number;
  }
  /** Index of the first of the page's words. */
  surfelsAt(index: number): number {
    return SURFELS_AT + index * PAGE_WORDS;
  }

  /** Takes changed pages from a store until the buffer is full. */
  fill(store: SurfelStore): void {
    this.count = 0;
    while (this.count < BUFFER_PAGES) {
      const page = store.takeChanged();
      if (page < 0) return;
      this.#write(store, page, this.count++);
    }
  }

  #write(store: SurfelStore, page: number, index: number): void {
    const chunk = store.pageChunks[page] as number;
    let at = this.surfelsAt(index);
    let oldest = 0xffff;
    const from = page * PAGE_SURFELS;
    const end = chunk < 0 ? from : from + (store.pageCounts[page] as number);
    for (let surfel = from; surfel < end; surfel++) {
      if ((store.sightings[surfel] as number) < 2) continue;
      const seen = ageUnits(store.seen[surfel] as number);
      oldest = Math.min(oldest, seen);
      this.words[at++] = store.places[surfel] as number;
      this.words[at++] = (store.colours[surfel] as number) | (seen << 16);
    }
    const header = index * HEADER_WORDS;
    this.#headers[header] = page;
    this.#headers[header + 1] = (at - this.surfelsAt(index)) / 2;
    this.#headers[header + 2] = chunk < 0 ? 0 : (store.chunkX[chunk] as number);
    this.#headers[header + 3] = chunk < 0 ? 0 : (store.chunkY[chunk] as number);
    this.#headers[header + 4] = chunk < 0 ? 0 : (store.chunkZ[chunk] as number);
    this.#headers[header + 5] = oldest;
  }
}
