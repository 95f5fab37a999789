/** Seeds of links that lose packets and jump: the same on each run. */
const COUNT = 20;
export const SEEDS: readonly number[] = Array.from({ length: COUNT }, (_, i) => i + 2);
