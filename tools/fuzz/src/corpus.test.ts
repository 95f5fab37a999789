import { casesOf } from '@farpoint/network-sim/cases';
import { expect, it } from 'vitest';
import { allTargets } from './all-targets.ts';
import { fuzz } from './fuzz.ts';
import { corpusOf } from './vectors.ts';

it('has every parser once', () => {
  const names = allTargets.map(({ name }) => name);
  expect(new Set(names).size).toBe(names.length);
});

it.each(allTargets)(
  '$name: seeds, corpus and mutations end in a value or a typed refusal',
  async (target) => {
    const inputs = Math.max(40, casesOf(2000) * (target.share ?? 1));
    const { crashes } = await fuzz(target, { inputs, seed: 1, corpus: corpusOf(target.name) });
    expect(crashes.map(({ error, input }) => `${error} at ${Buffer.from(input).toString('base64')}`)).toEqual(
      [],
    );
  },
);
