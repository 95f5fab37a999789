import fc from 'fast-check';
import { describe, expect, expectTypeOf, test } from 'vitest';
import * as schema from './option-schemas.ts';
import { defineOption, defineProgram, OptionsError } from './option-table.ts';
import { type OptionInput, resolveOptions } from './options.ts';

const program = defineProgram({
  name: 'farpoint-robot',
  summary: 'Streams point clouds.',
  version: '1.2.3',
  section: 'robot',
  options: {
    port: defineOption({ schema: schema.port(), default: 4000, argument: 'PORT', help: 'port' }),
    maxSpeed: defineOption({
      schema: schema.number({ min: 0, max: 2 }),
      default: 0.5,
      argument: 'MPS',
      help: 'limit',
    }),
    record: defineOption({ schema: schema.boolean(), default: false, help: 'record' }),
    brakes: defineOption({ schema: schema.boolean(), default: true, help: 'brake' }),
    cameras: defineOption({
      schema: schema.list(schema.text()),
      default: [],
      argument: 'A,B',
      help: 'cameras',
    }),
    token: defineOption({
      schema: schema.optional(schema.text({ min: 8 })),
      default: null,
      argument: 'TOKEN',
      help: 'token',
      secret: true,
      env: 'FARPOINT_TOKEN',
    }),
    source: defineOption({
      schema: schema.choice(['sim', 'shm']),
      default: 'sim',
      argument: 'KIND',
      help: 'source',
    }),
  },
});

function resolve(input: Partial<OptionInput> & { files?: Record<string, string> }) {
  return resolveOptions(program, {
    argv: input.argv ?? [],
    env: input.env ?? {},
    readFile: (path) => input.files?.[path] ?? null,
  });
}

function run(input: Parameters<typeof resolve>[0]) {
  const resolved = resolve(input);
  if (resolved.action !== 'run') throw new Error('expected to run');
  return resolved;
}

function mistake(input: Parameters<typeof resolve>[0]): string {
  try {
    resolve(input);
  } catch (error) {
    expect(error).toBeInstanceOf(OptionsError);
    return (error as OptionsError).message;
  }
  throw new Error('expected a mistake');
}

describe('where a value comes from', () => {
  const files = {
    'farpoint.yaml': 'robot:\n  port: 1\n  maxSpeed: 1.5\n  cameras: [a, b]\nsignaling:\n  any: 1\n',
  };

  test('defaults, typed', () => {
    const { values, sources, configPath } = run({});
    expect(values).toEqual({
      port: 4000,
      maxSpeed: 0.5,
      record: false,
      brakes: true,
      cameras: [],
      token: null,
      source: 'sim',
      config: null,
      logLevel: 'info',
      logFormat: 'auto',
    });
    expect(new Set(Object.values(sources))).toEqual(new Set(['default']));
    expect(configPath).toBeNull();
    expectTypeOf(values.port).toEqualTypeOf<number>();
    expectTypeOf(values.source).toEqualTypeOf<'sim' | 'shm'>();
    expectTypeOf(values.token).toEqualTypeOf<string | null>();
  });

  test('flag before environment before file before default', () => {
    const env = { FARPOINT_ROBOT_PORT: '2' };
    expect(run({ files }).values.port).toBe(1);
    expect(run({ files, env }).values.port).toBe(2);
    const all = run({ files, env, argv: ['--port', '3'] });
    expect(all.values).toMatchObject({ port: 3, maxSpeed: 1.5, cameras: ['a', 'b'], source: 'sim' });
    expect(all.sources).toMatchObject({ port: 'flag', maxSpeed: 'config', source: 'default' });
    expect(all.configPath).toBe('farpoint.yaml');
  });

  test('an empty variable counts as unset', () => {
    expect(run({ env: { FARPOINT_ROBOT_PORT: '' } }).values.port).toBe(4000);
  });

  test('booleans: --x and --no-x, words in the environment', () => {
    expect(run({ argv: ['--record', '--no-brakes'] }).values).toMatchObject({ record: true, brakes: false });
    expect(
      run({ argv: ['--no-record', '--brakes'], env: { FARPOINT_ROBOT_RECORD: 'yes' } }).values,
    ).toMatchObject({
      record: false,
      brakes: true,
    });
    expect(run({ env: { FARPOINT_ROBOT_RECORD: 'on', FARPOINT_ROBOT_BRAKES: '0' } }).values).toMatchObject({
      record: true,
      brakes: false,
    });
  });

  test('the file may be named by flag or environment', () => {
    const other = { 'other.yaml': 'robot: {port: 9}' };
    expect(run({ files: other, argv: ['--config', 'other.yaml'] }).values.port).toBe(9);
    expect(run({ files: other, env: { FARPOINT_CONFIG: 'other.yaml' } }).values.port).toBe(9);
  });

  test('an empty file and a missing section are no mistake', () => {
    expect(run({ files: { 'farpoint.yaml': '' } }).values.port).toBe(4000);
    expect(run({ files: { 'farpoint.yaml': 'signaling: {}' } }).values.port).toBe(4000);
    expect(run({ files: { 'farpoint.yaml': 'robot:' } }).values.port).toBe(4000);
  });

  test('mistyped variables are reported', () => {
    expect(run({ env: { FARPOINT_ROBOT_PROT: '1', FARPOINT_SIGNALING_X: '1' } }).unknownEnvironment).toEqual([
      'FARPOINT_ROBOT_PROT',
    ]);
  });
});

describe('mistakes name their place', () => {
  test.each([
    [{ argv: ['--port', '70000'] }, '--port must be a whole number from 0 to 65535, not "70000"'],
    [{ argv: ['--port', ''] }, '--port must be a whole number from 0 to 65535, not ""'],
    [
      { env: { FARPOINT_ROBOT_MAX_SPEED: 'fast' } },
      'FARPOINT_ROBOT_MAX_SPEED must be a number from 0 to 2, not "fast"',
    ],
    [
      { files: { 'farpoint.yaml': 'robot: {source: rosbag}' } },
      'farpoint.yaml: robot.source must be one of sim, shm, not "rosbag"',
    ],
    [
      { files: { 'farpoint.yaml': 'robot: {cameras: [a, []]}' } },
      'farpoint.yaml: robot.cameras.1 must be text, not ["a",[]]',
    ],
    [
      { files: { 'farpoint.yaml': 'robot: {prot: 1}' } },
      'farpoint.yaml: robot.prot is not an option (did you mean port?)',
    ],
    [
      { files: { 'farpoint.yaml': 'robto: {}' } },
      'farpoint.yaml: robto is not a section (did you mean robot?); the sections are robot, signaling, bridge, web, link',
    ],
    [{ files: { 'farpoint.yaml': '[1]' } }, 'farpoint.yaml must be a mapping from program to options'],
    [
      { files: { 'farpoint.yaml': 'robot: 7' } },
      'farpoint.yaml: robot must be a mapping from option to value',
    ],
    [{ argv: ['--config', 'nix.yaml'] }, '--config names a file that does not exist: nix.yaml'],
    [{ env: { FARPOINT_CONFIG: 'n' } }, 'FARPOINT_CONFIG names a file that does not exist: n'],
    [{ argv: ['--prot', '1'] }, "command line: unknown option '--prot' (Did you mean --port?)"],
    [{ argv: ['--port'] }, "command line: option '--port <PORT>' argument missing"],
    [{ env: { FARPOINT_TOKEN: 'short' } }, 'FARPOINT_TOKEN must be 8–4096 characters long'],
  ])('%j', (input, message) => {
    expect(mistake(input)).toBe(message);
  });

  test('positional arguments are refused', () => {
    expect(mistake({ argv: ['extra'] })).toMatch(/^command line: too many arguments/);
  });

  test('a file that is not YAML is refused with its line', () => {
    expect(mistake({ files: { 'farpoint.yaml': 'robot:\n  a: [\n' } })).toMatch(
      /^farpoint\.yaml is not valid YAML: .* at line 3/,
    );
  });

  test('any command line and any file either resolve or are refused as an OptionsError', () => {
    const argument = fc.oneof(
      fc.string(),
      fc.constantFrom('--port', '--no-port', '--record', '--', '-h', '--cameras', '--config', '--__proto__'),
    );
    fc.assert(
      fc.property(fc.array(argument, { maxLength: 6 }), fc.string({ maxLength: 80 }), (argv, file) => {
        try {
          resolve({ argv, files: { 'farpoint.yaml': file } });
        } catch (error) {
          expect(error).toBeInstanceOf(OptionsError);
        }
      }),
      { seed: 7, numRuns: 500 },
    );
  });
});

test('--help shows every flag with its default and its variable, secrets without value', () => {
  const resolved = resolve({ argv: ['--help'] });
  expect(resolved.action).toBe('print');
  const text = resolved.action === 'print' ? resolved.text.replace(/\s+/g, ' ') : '';
  for (const flag of [
    '--port <PORT>',
    '--max-speed <MPS>',
    '--record',
    '--no-brakes',
    '--cameras <A,B>',
    '--config',
  ]) {
    expect(text).toContain(flag);
  }
  expect(text).toContain('(default: 0.5, env: FARPOINT_ROBOT_MAX_SPEED)');
  expect(text).toContain('token (env: FARPOINT_TOKEN)');
  expect(resolve({ argv: ['--version'] })).toEqual({ action: 'print', text: 'farpoint-robot 1.2.3\n' });
});
