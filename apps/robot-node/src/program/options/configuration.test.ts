/** Whatever the file contains is either accepted, or refused with every mistake named by its line. */
import { casesOf, longProperty } from '@farpoint/network-sim/cases';
import { OptionsError, optionPlaces, resolveOptions } from '@farpoint/service';
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { stringify } from 'yaml';
import { toRobotOptions } from './robot-options.ts';
import { robotProgram } from './robot-program.ts';

const keys = optionPlaces(robotProgram).flatMap(({ file }) => (file === null ? [] : [file]));
const values = fc.oneof(
  fc.constantFrom<unknown>(
    null,
    true,
    0,
    1,
    -1,
    1e9,
    Number.NaN,
    '',
    'sim',
    'ros2',
    'auto',
    'ws://a',
    [],
    {},
  ),
  fc.constantFrom<unknown>(
    [{ topic: '/a', as: 'cloud' }],
    [{ topic: 7, of: 1 }],
    ['stun:a'],
    [{ urls: 'turn:a', credential: 'hidden' }],
  ),
  fc.string({ maxLength: 12 }),
  fc.double(),
);
const names = fc.oneof(
  { weight: 4, arbitrary: fc.constantFrom(...keys) },
  fc.constantFrom(
    'limits',
    'source',
    'soruce.kind',
    'limits.maxLinaer',
    '__proto__',
    'constructor',
    'toString',
  ),
  fc.string({ minLength: 1, maxLength: 8 }),
);

/** `{ 'a.b': 1 }` → `{ a: { b: 1 } }`. If two keys conflict, the later one stays. */
function nested(entries: readonly (readonly [string, unknown])[]): object {
  const root: Record<string, unknown> = Object.create(null) as Record<string, unknown>;
  for (const [key, value] of entries) {
    const [group = '', name] = key.split('.', 2);
    if (name === undefined) root[group] = value;
    else {
      const inside = typeof root[group] === 'object' && root[group] !== null ? root[group] : {};
      root[group] = { ...inside, [name]: value };
    }
  }
  return root;
}

it('accepts or refuses any mapping of known and unknown keys to any values', () => {
  let [taken, refused] = [0, 0];
  fc.assert(
    fc.property(fc.array(fc.tuple(names, values), { maxLength: 8 }), (entries) => {
      const text = stringify({ robot: nested(entries) });
      const lines = text.split('\n').length;
      try {
        const resolved = resolveOptions(robotProgram, { argv: [], env: {}, readFile: () => text });
        if (resolved.action === 'run') toRobotOptions(resolved.values, resolved.where);
        taken++;
      } catch (error) {
        expect(error).toBeInstanceOf(OptionsError);
        const { mistakes, message } = error as OptionsError;
        expect(mistakes.length).toBeGreaterThan(0);
        expect(message.split('\n').length).toBeGreaterThanOrEqual(mistakes.length);
        for (const { where, detail, line, key = '', found } of mistakes) {
          if (/^robot\.(network\.iceServers|signaling\.(token|key)\b)/.test(key))
            expect(found).toBeUndefined();
          expect(where).toMatch(/farpoint\.yaml|^--/);
          expect(detail).toMatch(/^(must|is|has|needs|cannot|not|can|there|\/)/);
          if (line !== undefined) expect(line).toBeGreaterThan(0);
          if (line !== undefined) expect(line).toBeLessThanOrEqual(lines);
        }
        refused++;
      }
    }),
    longProperty(11, 1000),
  );
  expect(taken).toBeGreaterThan(casesOf(50));
  expect(refused).toBeGreaterThan(casesOf(300));
});
