/**
 * Surfels in typed arrays, in pages that belong to chunks; found by chunk and voxel. The number of pages bounds the memory.
 * Allocates only when it is made.
 */
import { KeyIndex } from './key-index.ts';
import { PAGE_SURFELS, voxelOf } from './memory-layout.ts';

/** Voxels of a chunk. */
const VOXELS = 32 ** 3;
/** Chunks' coordinates are 16 bits, signed: 52 km at 1.6 m. */
const HALF = 32_768;

export class SurfelStore {
  /** By surfel: its place in its chunk (memory-layout.ts). */
  readonly places: Uint32Array;
  /** 5-6-5 bits, R highest. */
  readonly colours: Uint16Array;
  /** When it was last seen, ticks; of a surfel that is not confirmed: first. */
  readonly seen: Uint32Array;
  /** In how many frames; 1: not confirmed. */
  readonly sightings: Uint8Array;
  /** The least distance from which it was measured, in 5 cm. */
  readonly distances: Uint8Array;
  /** By page: the surfels in it, its chunk (−1: free), and the next page of the chunk (−1: none). */
  readonly pageCounts: Uint16Array;
  readonly pageChunks: Int32Array;
  readonly pageNext: Int32Array;
  /** By chunk: its coordinates, its first page (−1: no such chunk), and when something in it was last seen, ticks. */
  readonly chunkX: Int16Array;
  readonly chunkY: Int16Array;
  readonly chunkZ: Int16Array;
  readonly chunkPages: Int32Array;
  readonly chunkSeen: Uint32Array;
  /** Number of pages, which is also the most chunks. */
  readonly pages: number;
  /** Number of surfels. */
  count = 0;
  readonly #surfelIndex: KeyIndex;
  readonly #chunkIndex: KeyIndex;
  readonly #freePages: Int32Array;
  #freePageCount = 0;
  readonly #freeChunks: Int32Array;
  #freeChunkCount = 0;
  /** A ring of pages that have changed, each at most once. */
  readonly #changed: Int32Array;
  readonly #isChanged: Uint8Array;
  #changedAt = 0;
  #changedCount = 0;

  /** @param pages the most pages, of {@link PAGE_SURFELS} surfels each */
  constructor(pages: number) {
    this.pages = pages;
    const surfels = pages * PAGE_SURFELS;
    this.places = new Uint32Array(surfels);
    this.colours = new Uint16Array(surfels);
    this.seen = new Uint32Array(surfels);
    this.sightings = new Uint8Array(surfels);
    this.distances = new Uint8Array(surfels);
    this.pageCounts = new Uint16Array(pages);
    this.pageChunks = new Int32Array(pages);
    this.pageNext = new Int32Array(pages);
    this.chunkX = new Int16Array(pages);
    this.chunkY = new Int16Array(pages);
    this.chunkZ = new Int16Array(pages);
    this.chunkPages = new Int32Array(pages);
    this.chunkSeen = new Uint32Array(pages);
    this.#freePages = new Int32Array(pages);
    this.#freeChunks = new Int32Array(pages);
    this.#changed = new Int32Array(pages);
    this.#isChanged = new Uint8Array(pages);
    this.#surfelIndex = new KeyIndex(surfels, (surfel) => this.#keyOf(surfel));
    this.#chunkIndex = new KeyIndex(pages, (chunk) =>
      chunkKey(this.chunkX[chunk] as number, this.chunkY[chunk] as number, this.chunkZ[chunk] as number),
    );
    this.clear();
  }

  /** Bytes that everything takes. */
  get bytes(): number {
    const perSurfel = 4 + 2 + 4 + 1 + 1;
    const perPage = 2 + 4 + 4 + 3 * 2 + 4 + 4 + 4 + 4 + 4 + 1;
    const indices = this.#surfelIndex.bytes + this.#chunkIndex.bytes;
    return this.pages * (PAGE_SURFELS * perSurfel + perPage) + indices;
  }

  /** Pages in use. */
  get usedPages(): number {
    return this.pages - this.#freePageCount;
  }

  /** Number of pages that have changed and were not taken yet. */
  get changedPages(): number {
    return this.#changedCount;
  }

  /** Forgets everything; no page counts as changed. */
  clear(): void {
    this.count = 0;
    this.pageCounts.fill(0);
    this.pageChunks.fill(-1);
    this.chunkPages.fill(-1);
    this.#surfelIndex.clear();
    this.#chunkIndex.clear();
    for (let i = 0; i < this.pages; i++) {
      this.#freePages[i] = this.pages - 1 - i;
      this.#freeChunks[i] = this.pages - 1 - i;
    }
    this.#freePageCount = this.pages;
    this.#freeChunkCount = this.pages;
    this.#isChanged.fill(0);
    this.#changedCount = 0;
  }

  /** The chunk with these coordinates; −1 if there is none. */
  findChunk(x: number, y: number, z: number): number {
    return this.#chunkIndex.find(chunkKey(x, y, z));
  }

  /** Whether a chunk exists and has these coordinates. */
  isChunk(chunk: number, x: number, y: number, z: number): boolean {
    if ((this.chunkPages[chunk] as number) < 0 || this.chunkX[chunk] !== x) return false;
    return this.chunkY[chunk] === y && this.chunkZ[chunk] === z;
  }

  /** Adds a chunk that does not exist yet; −1 if there is no page for it. */
  addChunk(x: number, y: number, z: number): number {
    const page = this.#takePage();
    if (page < 0) return -1;
    const chunk = this.#freeChunks[--this.#freeChunkCount] as number;
    this.chunkX[chunk] = x;
    this.chunkY[chunk] = y;
    this.chunkZ[chunk] = z;
    this.#chunkIndex.add(chunkKey(x, y, z), chunk);
    this.chunkPages[chunk] = page;
    this.chunkSeen[chunk] = 0;
    this.pageChunks[page] = chunk;
    this.pageNext[page] = -1;
    return chunk;
  }

  /** The surfel in the voxel of a place; −1 if there is none. */
  find(chunk: number, place: number): number {
    return this.#surfelIndex.find(chunk * VOXELS + voxelOf(place));
  }

  /** Adds a surfel to a voxel that has none; −1 if there is no page for it. The caller sets everything but its place. */
  add(chunk: number, place: number): number {
    let page = this.chunkPages[chunk] as number;
    if (this.pageCounts[page] === PAGE_SURFELS) {
      const added = this.#takePage();
      if (added < 0) return -1;
      this.pageChunks[added] = chunk;
      this.pageNext[added] = page;
      this.chunkPages[chunk] = added;
      page = added;
    }
    const surfel = page * PAGE_SURFELS + (this.pageCounts[page] as number);
    this.pageCounts[page] = (this.pageCounts[page] as number) + 1;
    this.places[surfel] = place;
    this.#surfelIndex.add(chunk * VOXELS + voxelOf(place), surfel);
    this.count++;
    return surfel;
  }

  /**
   * Removes a surfel; the last one of the chunk's first page takes its index. Whoever goes through a chunk's pages in
   * their order, and through each from its end, meets every surfel once, whatever is removed.
   */
  remove(surfel: number): void {
    const page = Math.floor(surfel / PAGE_SURFELS);
    const chunk = this.pageChunks[page] as number;
    const first = this.chunkPages[chunk] as number;
    const last = first * PAGE_SURFELS + (this.pageCounts[first] as number) - 1;
    this.#surfelIndex.remove(this.#keyOf(surfel), surfel);
    if (last !== surfel) {
      this.#surfelIndex.move(this.#keyOf(last), last, surfel);
      this.places[surfel] = this.places[last] as number;
      this.colours[surfel] = this.colours[last] as number;
      this.seen[surfel] = this.seen[last] as number;
      this.sightings[surfel] = this.sightings[last] as number;
      this.distances[surfel] = this.distances[last] as number;
      this.noteChange(page);
    }
    this.noteChange(first);
    this.count--;
    this.pageCounts[first] = (this.pageCounts[first] as number) - 1;
    if (this.pageCounts[first] !== 0) return;
    this.chunkPages[chunk] = this.pageNext[first] as number;
    this.#freePage(first);
    if (this.chunkPages[chunk] === -1) this.#freeChunk(chunk);
  }

  /** Removes a chunk with everything in it. */
  removeChunk(chunk: number): void {
    for (let page = this.chunkPages[chunk] as number; page >= 0; ) {
      const next = this.pageNext[page] as number;
      for (let i = (this.pageCounts[page] as number) - 1; i >= 0; i--) {
        const surfel = page * PAGE_SURFELS + i;
        this.#surfelIndex.remove(this.#keyOf(surfel), surfel);
      }
      this.count -= this.pageCounts[page] as number;
      this.pageCounts[page] = 0;
      this.noteChange(page);
      this.#freePage(page);
      page = next;
    }
    this.#freeChunk(chunk);
  }

  /** A page is to be handed on. */
  noteChange(page: number): void {
    if (this.#isChanged[page] === 1) return;
    this.#isChanged[page] = 1;
    this.#changed[(this.#changedAt + this.#changedCount++) % this.pages] = page;
  }

  /** The page that changed first; −1 if none has. */
  takeChanged(): number {
    if (this.#changedCount === 0) return -1;
    const page = this.#changed[this.#changedAt] as number;
    this.#changedAt = (this.#changedAt + 1) % this.pages;
    this.#changedCount--;
    this.#isChanged[page] = 0;
    return page;
  }

  #keyOf(surfel: number): number {
    const chunk = this.pageChunks[Math.floor(surfel / PAGE_SURFELS)] as number;
    return chunk * VOXELS + voxelOf(this.places[surfel] as number);
  }

  #takePage(): number {
    return this.#freePageCount === 0 ? -1 : (this.#freePages[--this.#freePageCount] as number);
  }

  #freePage(page: number): void {
    this.pageChunks[page] = -1;
    this.#freePages[this.#freePageCount++] = page;
  }

  #freeChunk(chunk: number): void {
    const key = chunkKey(
      this.chunkX[chunk] as number,
      this.chunkY[chunk] as number,
      this.chunkZ[chunk] as number,
    );
    this.#chunkIndex.remove(key, chunk);
    this.chunkPages[chunk] = -1;
    this.#freeChunks[this.#freeChunkCount++] = chunk;
  }
}

function chunkKey(x: number, y: number, z: number): number {
  return x + HALF + (y + HALF) * 2 ** 16 + (z + HALF) * 2 ** 32;
}
