/**
 * Seeded pseudo-random numbers: sfc32 (PractRand's small fast counting generator), 128 bits of state, seeded by
 * splitmix32. Each use of a link has its own stream, so that enabling one impairment does not change the others.
 */
export class Random {
  #a = 0;
  #b = 0;
  #c = 0;
  #counter = 1;

  /**
   * @param seed any integer
   * @param stream which of the seed's independent sequences
   */
  constructor(seed: number, stream: number) {
    this.#a = mix(seed | 0);
    this.#b = mix((seed / 0x100000000) | 0);
    this.#c = mix((stream + 0x9e3779b9) | 0);
    for (let i = 0; i < 12; i++) this.next();
  }

  /** Uniform in [0, 1), 32 bits. */
  next(): number {
    const sum = (this.#a + this.#b + this.#counter) | 0;
    this.#counter = (this.#counter + 1) | 0;
    this.#a = this.#b ^ (this.#b >>> 9);
    this.#b = (this.#c + (this.#c << 3)) | 0;
    this.#c = (((this.#c << 21) | (this.#c >>> 11)) + sum) | 0;
    return (sum >>> 0) / 0x100000000;
  }

  /** True with this probability. Draws nothing for 0 and 1. */
  chance(probability: number): boolean {
    if (probability <= 0) return false;
    return probability >= 1 || this.next() < probability;
  }
}

/** Uniform in [0, 1) from a counter: the same for the same arguments, whatever was drawn before. */
export function hashUniform(seed: number, counter: number): number {
  const low = mix((seed ^ Math.imul(counter | 0, 0x85ebca6b)) | 0);
  return (mix((low + ((counter / 0x100000000) | 0)) | 0) >>> 0) / 0x100000000;
}

function mix(value: number): number {
  let x = (value + 0x9e3779b9) | 0;
  x = Math.imul(x ^ (x >>> 16), 0x21f0aaad);
  x = Math.imul(x ^ (x >>> 15), 0x735a2d97);
  return x ^ (x >>> 15);
}
