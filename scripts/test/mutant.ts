/** Reads `tests/mutants.yaml`: faults that tests must find. Pure. */
import { parse } from 'yaml';
import * as z from 'zod';

const mutantSchema = z.strictObject({
  /** What the product does with it. */
  what: z.string(),
  file: z.string(),
  /** The text that is replaced, which occurs once in the file. */
  from: z.string().min(1),
  to: z.string(),
  /** The tests that are to find it, in this order: `pure`, or files. */
  'found-by': z.array(z.string()).min(1),
});

export interface Mutant {
  name: string;
  what: string;
  file: string;
  from: string;
  to: string;
  foundBy: readonly string[];
}

/** @throws {Error} that says what is wrong, and where */
export function readMutants(yaml: string): Mutant[] {
  return Object.entries(z.record(z.string(), mutantSchema).parse(parse(yaml))).map(([name, mutant]) => {
    const { what, file, from, to, 'found-by': foundBy } = mutant;
    return { name, what, file, from, to, foundBy };
  });
}

/** @throws {Error} if the text to be replaced is not there, or there more than once */
export function mutate({ name, file, from, to }: Mutant, text: string): string {
  const parts = text.split(from);
  if (parts.length !== 2)
    throw new Error(
      `${name}: ${parts.length === 1 ? 'not found' : 'found more than once'} in ${file}: ${from}`,
    );
  return parts.join(to);
}
