/**
 * A hash table from keys to the indices of items that know their own keys: open addressing with linear probing, one
 * 32-bit number per slot. Allocates only when it is made.
 */
export class KeyIndex {
  /** The item + 1; 0: free. */
  readonly #slots: Uint32Array;
  readonly #mask: number;
  readonly #keyOf: (item: number) => number;

  /**
   * @param capacity the most items
   * @param keyOf the key of an item that is in the table: a whole number below 2⁵³
   */
  constructor(capacity: number, keyOf: (item: number) => number) {
    const size = 2 ** Math.ceil(Math.log2(Math.max(capacity * 2, 2)));
    this.#slots = new Uint32Array(size);
    this.#mask = size - 1;
    this.#keyOf = keyOf;
  }

  /** Bytes that the table takes. */
  get bytes(): number {
    return this.#slots.byteLength;
  }

  /** The item with this key; −1 if there is none. */
  find(key: number): number {
    const slots = this.#slots;
    for (let slot = this.#home(key); ; slot = (slot + 1) & this.#mask) {
      const item = (slots[slot] as number) - 1;
      if (item < 0 || this.#keyOf(item) === key) return item;
    }
  }

  /** Adds an item whose key is not in the table. */
  add(key: number, item: number): void {
    const slots = this.#slots;
    let slot = this.#home(key);
    while (slots[slot] !== 0) slot = (slot + 1) & this.#mask;
    slots[slot] = item + 1;
  }

  /** The item with this key gets another index. */
  move(key: number, from: number, to: number): void {
    const slots = this.#slots;
    let slot = this.#home(key);
    while (slots[slot] !== from + 1) slot = (slot + 1) & this.#mask;
    slots[slot] = to + 1;
  }

  /** Removes an item that is in the table. Its key, and those of all others, must still be known. */
  remove(key: number, item: number): void {
    const slots = this.#slots;
    const mask = this.#mask;
    let hole = this.#home(key);
    while (slots[hole] !== item + 1) hole = (hole + 1) & mask;
    // Moves back what would no longer be found behind the hole.
    for (let next = (hole + 1) & mask; slots[next] !== 0; next = (next + 1) & mask) {
      const home = this.#home(this.#keyOf((slots[next] as number) - 1));
      if (((next - home) & mask) < ((next - hole) & mask)) continue;
      slots[hole] = slots[next] as number;
      hole = next;
    }
    slots[hole] = 0;
  }

  clear(): void {
    this.#slots.fill(0);
  }

  #home(key: number): number {
    let hash = Math.imul((key >>> 0) ^ Math.imul(Math.floor(key / 2 ** 32), 0x85ebca6b), 0x9e3779b1);
    hash ^= hash >>> 15;
    hash = Math.imul(hash, 0xc2b2ae35);
    return (hash ^ (hash >>> 13)) & this.#mask;
  }
}
