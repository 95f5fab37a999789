import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, expectTypeOf, test } from 'vitest';
import { asksForHelp, benchOptions, option } from './bench-options.ts';

const TABLE = {
  points: option.number(30_000, { least: 150 }),
  rateMbps: option.number(undefined, { least: 0.1 }),
  sensors: option.number(1, { least: 1, most: 8, whole: true }),
  mode: option.choice('points64', ['points64', 'auto']),
  loss: option.list([0.01, 0.05], option.number(undefined)),
  width: option.of(4, 'WIDTH', (text) => (text === '' ? undefined : Number(text))),
  plot: option.text(),
  canvas: option.text('160x90'),
  surface: option.flag,
  codec: option.repeated,
};
const read = (...argv: string[]) => benchOptions(argv, TABLE);

test('an option that is not given has its default', () => {
  expect(read()).toEqual({
    points: 30_000,
    rateMbps: undefined,
    sensors: 1,
    mode: 'points64',
    loss: [0.01, 0.05],
    width: 4,
    plot: undefined,
    canvas: '160x90',
    surface: false,
    codec: [],
    json: false,
  });
});

test('the kind of an option is the type of its value', () => {
  expectTypeOf({ ...read() }).toEqualTypeOf<{
    points: number;
    rateMbps: number | undefined;
    sensors: number;
    mode: 'points64' | 'auto';
    loss: number[];
    width: number;
    plot: string | undefined;
    canvas: string;
    surface: boolean;
    codec: string[];
    json: boolean;
  }>();
});

test('values are converted, and `rateMbps` is --rate-mbps', () => {
  const argv =
    '--points 150 --rate-mbps=0.5 --sensors 8 --mode auto --loss 0,1 --width 7 --plot a.svg --json';
  expect(read(...argv.split(' '), '--surface', '--codec', 'zstd', '--codec', 'draco')).toEqual({
    points: 150,
    rateMbps: 0.5,
    sensors: 8,
    mode: 'auto',
    loss: [0, 1],
    width: 7,
    plot: 'a.svg',
    canvas: '160x90',
    surface: true,
    codec: ['zstd', 'draco'],
    json: true,
  });
});

describe('an error names the option, the value, and what is allowed', () => {
  test.each([
    ['--points=many', '--points is `many`, not a number of at least 150'],
    ['--points=149', '--points is `149`, not a number of at least 150'],
    ['--points=', '--points is ``, not a number of at least 150'],
    ['--points=Infinity', '--points is `Infinity`, not a number of at least 150'],
    ['--rate-mbps=0', '--rate-mbps is `0`, not a number of at least 0.1'],
    ['--sensors=9', '--sensors is `9`, not a whole number from 1 to 8'],
    ['--sensors=1.5', '--sensors is `1.5`, not a whole number from 1 to 8'],
    ['--mode=whole', '--mode is `whole`, not one of points64, auto'],
    ['--loss=0.1,-1', '--loss is `0.1,-1`, not a number of at least 0, or several with commas between them'],
    ['--width=', '--width is ``, not WIDTH'],
  ])('%s', (given, sentence) => {
    expect(() => read(given)).toThrow(new Error(sentence));
  });

  test('that does not exist, or lacks its value', () => {
    const known = /the options are --points, --rate-mbps, .*--codec, --json, --help$/;
    expect(() => read('--point', '1')).toThrow(/^Unknown option '--point'; /);
    expect(() => read('--point', '1')).toThrow(known);
    expect(() => read('--points')).toThrow(/^Option '--points <value>' argument missing; /);
    expect(() => read('--points')).toThrow(known);
  });
});

test('an argument without a name is refused, unless the table takes some', () => {
  expect(() => read('cloud.pcd')).toThrow("Unexpected argument 'cloud.pcd'");
  const table = { cloud: option.repeated, others: option.bare };
  expect(benchOptions(['--cloud', 'a', 'b'], table)).toEqual({ cloud: ['a'], others: ['b'], json: false });
});

test('help is asked for before `--` alone: what follows is for another program', () => {
  expect(asksForHelp(['--points', '1', '--help'])).toBe(true);
  expect(asksForHelp(['folder', '--', 'link', '--help'])).toBe(false);
});

test('every benchmark reads its options here, and its help names each', () => {
  const sources = readdirSync(import.meta.dirname)
    .filter((file) => file.endsWith('.ts') && !file.endsWith('.test.ts') && file !== 'bench-options.ts')
    .map((file) => ({ file, text: readFileSync(join(import.meta.dirname, file), 'utf8') }));
  const others = sources.filter(({ text }) => text.includes('parseArgs')).map(({ file }) => file);
  expect(others, 'no benchmark, but a program that one starts').toEqual(['shm-producer.ts']);
  const silent = sources.flatMap(({ file, text }) =>
    [...text.matchAll(/^ +(\w+): option\.(?!bare)/gm)]
      .map(([, key]) => `--${(key as string).replaceAll(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`)
      .filter((name) => !new RegExp(`${name}(?![\\w-])`).test(text))
      .map((name) => `${file}: ${name}`),
  );
  expect(silent, 'left out on purpose').toEqual(['link-options.ts: --keep']);
});
