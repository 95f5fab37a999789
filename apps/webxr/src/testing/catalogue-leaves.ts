/** The texts of a catalogue, one by one, for tests that read all of them. */

export interface Leaf {
  readonly path: readonly string[];
  readonly text: string | ((...named: unknown[]) => string);
}

export function leavesOf(value: unknown, path: readonly string[] = []): Leaf[] {
  if (typeof value === 'string' || typeof value === 'function')
    return [{ path, text: value as Leaf['text'] }];
  return Object.entries(value as object).flatMap(([key, part]) => leavesOf(part, [...path, key]));
}

/** Stands for whatever a text names: a name, a number, a list, and an object with such fields. */
function standIn(name: string): unknown {
  const named: unknown = new Proxy(() => name, {
    get: (_, key) => {
      if (key === 'map') return () => named;
      return key === Symbol.toPrimitive || key === 'join' ? () => name : named;
    },
  });
  return named;
}

/** @param name stands for each thing that the text names @returns empty where a text chooses by what it names */
export function said({ text }: Leaf, name: string): string {
  if (typeof text === 'string') return text;
  const named = standIn(name);
  return text(named, named, named, named) ?? '';
}
