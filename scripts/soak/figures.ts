/** Figures of benchmarks, compared with the medians of earlier soaks on the same machine. Pure. */

export type Figures = Record<string, number>;

/** A figure that is farther from its median is named. */
const FAR = 0.25;
/** From so many earlier soaks on there is a median. */
const LEAST_EARLIER = 3;
/** Of each figure. */
const KEPT = 9;

/** The numbers in the last line of output that is a JSON object, by their paths; none if there is no such line. */
export function figuresIn(output: string): Figures {
  const line = output
    .trimEnd()
    .split('\n')
    .findLast((each) => each.startsWith('{'));
  const figures: Figures = {};
  const take = (value: unknown, path: string): void => {
    if (typeof value === 'number' && Number.isFinite(value)) figures[path] = value;
    else if (typeof value === 'object' && value !== null)
      for (const [key, inner] of Object.entries(value)) take(inner, path === '' ? key : `${path}.${key}`);
  };
  try {
    take(JSON.parse(line ?? '{}'), '');
  } catch {
    return {};
  }
  return figures;
}

export function median(values: readonly number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  const middle = sorted.length / 2;
  return sorted.length % 2 === 1
    ? (sorted[Math.floor(middle)] as number)
    : ((sorted[middle - 1] as number) + (sorted[middle] as number)) / 2;
}

/** @returns words for each figure that is far from its median, farthest first */
export function farFromMedians(now: Figures, earlier: readonly Figures[]): string[] {
  const far = Object.entries(now).flatMap(([name, value]) => {
    const values = earlier.flatMap((each) => each[name] ?? []);
    if (values.length < LEAST_EARLIER) return [];
    const usual = median(values);
    const by = usual === 0 ? 0 : Math.abs(value - usual) / Math.abs(usual);
    return by > FAR ? [{ by, words: `${name} ${short(value)} (median ${short(usual)})` }] : [];
  });
  return far.sort((a, b) => b.by - a.by).map(({ words }) => words);
}

/** The figures of this soak and of those before, the newest last. */
export function withNewest(earlier: readonly Figures[], now: Figures): Figures[] {
  return [...earlier, now].slice(-KEPT);
}

function short(value: number): string {
  return String(Number(value.toPrecision(4)));
}
