import { expect, test } from 'vitest';
import { DevOptionError, readDevOptions } from './dev-options.ts';

test('options have defaults', () => {
  expect(readDevOptions([])).toEqual({ port: null, robots: 1, lan: false, verbose: false });
  expect(readDevOptions(['--robots', '2', '--port=8080', '--lan', '--verbose'])).toEqual({
    ...{ port: 8080, robots: 2, lan: true, verbose: true },
  });
  expect(readDevOptions(['--help'])).toBeNull();
  expect(readDevOptions(['-h'])).toBeNull();
});

test.each([
  [['--robot', '2'], '--robot is not an option (did you mean --robots?); `pnpm dev --help` lists them'],
  [['2'], '"2" does not belong to an option; `pnpm dev --help` lists them'],
  [['-x'], '-x is not an option; `pnpm dev --help` lists them'],
  [['--robots'], '--robots needs a number after it; `pnpm dev --help` lists them'],
  [['--robots', 'two'], '--robots must be a whole number from 1 to 16, not "two"'],
  [['--robots', '17'], '--robots must be a whole number from 1 to 16, not "17"'],
  [['--port', '0'], '--port must be a whole number from 1 to 65535, not "0"'],
  [['--verbose=yes'], '--verbose takes no value, not "yes"'],
])('%j is one sentence', (argv, words) => {
  expect(() => readDevOptions(argv)).toThrow(new DevOptionError(words));
});
