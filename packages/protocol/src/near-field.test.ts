import fc from 'fast-check';
import { expect, test } from 'vitest';
import { decodeJson, encodeJson } from './json.ts';
import {
  NEAR_REACH_M,
  NEAR_SECTORS,
  NEAR_STEP_M,
  type NearSector,
  nearFieldText,
  nearKinds,
  nearSectors,
} from './near-field.ts';
import { telemetryCodec } from './telemetry.ts';

const steps = fc.integer({ min: 0, max: 126 }).map((n) => n * NEAR_STEP_M);
const stretch = fc
  .tuple(fc.integer({ min: 0, max: 126 }), fc.integer({ min: 1, max: 127 }))
  .filter(([from, to]) => from < to)
  .map(([from, to]) => ({ fromM: from * NEAR_STEP_M, toM: to * NEAR_STEP_M }));
const sector: fc.Arbitrary<NearSector> = fc.record({
  hit: fc.option(fc.record({ kind: fc.constantFrom(...nearKinds), metres: steps })),
  unseen: fc.option(stretch),
});
const ring = fc.array(sector, { minLength: NEAR_SECTORS, maxLength: NEAR_SECTORS });

test('whatever is told is read again', () => {
  fc.assert(
    fc.property(ring, (sectors) => {
      const message = { type: 'nearField' as const, timeMs: 5, sectors: nearFieldText(sectors) };
      const read = decodeJson(telemetryCodec, encodeJson(telemetryCodec, message));
      expect(read).toEqual(message);
      expect(nearSectors(message)).toEqual(sectors);
    }),
    { seed: 1, numRuns: 100 },
  );
});

const NO_SECTOR: NearSector = { hit: null, unseen: null };
const told = (sector: Partial<NearSector>) =>
  nearSectors({ sectors: nearFieldText([{ ...NO_SECTOR, ...sector }]) })[0];

test('a distance is never told as farther than it is, and what is out of reach is not told', () => {
  const metres = (metres: number) => told({ hit: { kind: 'drop', metres } })?.hit?.metres;
  expect(metres(0.3)).toBe(12 * NEAR_STEP_M);
  expect(metres(0.324)).toBe(12 * NEAR_STEP_M);
  expect(metres(-0.04)).toBe(0);
  expect(metres(NEAR_REACH_M)).toBe(NEAR_REACH_M);
  for (const far of [NEAR_REACH_M + NEAR_STEP_M, 100, Number.POSITIVE_INFINITY, Number.NaN])
    expect(told({ hit: { kind: 'drop', metres: far } })).toEqual(NO_SECTOR);
});

test('an unseen stretch is told at its full length or longer, never as nothing', () => {
  expect(told({ unseen: { fromM: 0.33, toM: 0.51 } })?.unseen).toEqual({
    fromM: 13 * NEAR_STEP_M,
    toM: 21 * NEAR_STEP_M,
  });
  expect(told({ unseen: { fromM: 0.3, toM: 0.3 } })?.unseen).toEqual({
    fromM: 12 * NEAR_STEP_M,
    toM: 13 * NEAR_STEP_M,
  });
  expect(told({ unseen: { fromM: 3, toM: 9 } })?.unseen?.toM).toBe(127 * NEAR_STEP_M);
});

test('a message of any other bytes is refused', () => {
  const near = ring.map((sectors) => Uint8Array.from(atob(nearFieldText(sectors)), (it) => it.charCodeAt(0)));
  const changed = fc.tuple(near, fc.nat(215), fc.nat(255)).map(([bytes, at, byte]) => bytes.with(at, byte));
  const bytes = fc.oneof(changed, fc.uint8Array({ minLength: 213, maxLength: 219, size: 'max' }));
  fc.assert(
    fc.property(bytes, (given) => {
      const sectors = btoa(String.fromCharCode(...given));
      const valid = given.length === 3 * NEAR_SECTORS && isValid([...given]);
      const read = () =>
        decodeJson(telemetryCodec, JSON.stringify({ type: 'nearField', timeMs: 0, sectors }));
      if (valid) read();
      else expect(read).toThrow('sectors');
    }),
    { seed: 2, numRuns: 500 },
  );
});

/** As docs/protocol.md has it. */
function isValid(bytes: readonly number[]): boolean {
  for (let i = 0; i < bytes.length; i += 3) {
    const [first, from, to] = bytes.slice(i, i + 3) as [number, number, number];
    if (first === 255 || to > 127) return false;
    if (from === 127 ? to !== 127 : from >= to) return false;
  }
  return true;
}
