/** ` (did you mean x?)` if one of the known names is close to a mistyped one, else an empty string. */
export function closest(name: string, known: readonly string[]): string {
  return didYouMean(nearest(name, known));
}

/**
 * Like {@link closest}, for dotted keys of a file: finds a mistyped key, a key in the wrong group (`robot.maxLinear`
 * for `robot.limits.maxLinear`), or both.
 *
 * @param parent the mapping that contains the key, dotted; empty at the top
 * @param known every key, dotted
 */
export function closestKey(parent: string, name: string, known: readonly string[]): string {
  const inside = parent === '' ? '' : `${parent}.`;
  const siblings = new Set(
    known.filter((key) => key.startsWith(inside)).map((key) => key.slice(inside.length).split('.')[0]!),
  );
  const sibling = nearest(name, [...siblings]);
  if (sibling !== null) return didYouMean(`${inside}${sibling}`);
  const leaf = (key: string) => key.slice(key.lastIndexOf('.') + 1);
  // A key that formerly had no group: adminPort is now admin.port.
  const joined = known.find((key) => key.replaceAll('.', '').toLowerCase() === name.toLowerCase());
  const moved = joined ?? known.find((key) => leaf(key).toLowerCase() === name.toLowerCase());
  if (moved !== undefined) return didYouMean(moved);
  const near = nearest(name, known.map(leaf));
  return didYouMean(near === null ? null : (known.find((key) => leaf(key) === near) ?? null));
}

function didYouMean(name: string | null): string {
  return name === null ? '' : ` (did you mean ${name}?)`;
}

function nearest(name: string, known: readonly string[]): string | null {
  let best: string | null = null;
  // Two swapped letters are a distance of 2.
  let bestDistance = Math.max(name.length < 4 ? 1 : 2, Math.floor(name.length / 3)) + 1;
  for (const candidate of known) {
    const distance = editDistance(name.toLowerCase(), candidate.toLowerCase());
    if (distance < bestDistance) {
      best = candidate;
      bestDistance = distance;
    }
  }
  return best;
}

/** Levenshtein distance, row by row. */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, column) => column);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      const substitution = row[j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1);
      next.push(Math.min(substitution, row[j]! + 1, next[j - 1]! + 1));
    }
    row = next;
  }
  return row[b.length]!;
}
