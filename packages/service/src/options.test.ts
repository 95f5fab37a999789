import fc from 'fast-check';
import { describe, expect, expectTypeOf, test } from 'vitest';
import * as z from 'zod';
import { OptionsError } from './option-errors.ts';
import * as schema from './option-schemas.ts';
import { defineOption, defineProgram, mergeGroups, optionGroup } from './option-table.ts';
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
    ...optionGroup('limits', {
      turn: defineOption({ schema: schema.number({ min: 0 }), default: 1, argument: 'R', help: 'turn' }),
    }),
    topics: defineOption({
      schema: z.array(z.strictObject({ topic: z.string(), most: z.number().max(100).optional() })),
      default: [],
      flag: false,
      env: false,
      help: 'topics',
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

/** The file as the only input. */
const file = (text: string) => ({ files: { 'farpoint.yaml': text } });

function mistake(input: Parameters<typeof resolve>[0]): string {
  try {
    resolve(input);
  } catch (error) {
    expect(error).toBeInstanceOf(OptionsError);
    return (error as OptionsError).message;
  }
  throw new Error('expected a mistake');
}

describe('the source of a value', () => {
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
      turn: 1,
      topics: [],
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
    expect(run(file('')).values.port).toBe(4000);
    expect(run(file('signaling: {}')).values.port).toBe(4000);
    expect(run(file('robot:')).values.port).toBe(4000);
  });

  test('mistyped variables are reported', () => {
    expect(run({ env: { FARPOINT_ROBOT_PROT: '1', FARPOINT_SIGNALING_X: '1' } }).unknownEnvironment).toEqual([
      'FARPOINT_ROBOT_PROT',
    ]);
  });
});

describe('groups of the file', () => {
  test('define where a key is; flag and variable keep their names', () => {
    expect(run(file('robot:\n  limits:\n    turn: 2\n')).values.turn).toBe(2);
    expect(run({ argv: ['--turn', '3'], env: { FARPOINT_ROBOT_TURN: '4' } }).values.turn).toBe(3);
    expect(run(file('robot: {log: {level: debug}}')).values.logLevel).toBe('debug');
    expect(run(file('robot:\n  limits:\n')).values.turn).toBe(1);
  });

  test('report where a value comes from', () => {
    const files = { 'farpoint.yaml': 'robot:\n  limits:\n    turn: 2\n' };
    const { where } = run({ files, argv: ['--port', '1'], env: { FARPOINT_TOKEN: 'long enough' } });
    expect([where('turn'), where('port'), where('token'), where('source'), where('topics')]).toEqual([
      'farpoint.yaml:3: robot.limits.turn',
      '--port',
      'FARPOINT_TOKEN',
      '--source (or robot.source in farpoint.yaml)',
      'farpoint.yaml: robot.topics',
    ]);
    expect(run({}).where('source')).toBe('--source');
  });

  test.each([
    ['robot: {turn: 1}', 'farpoint.yaml:1: robot.turn is not an option (did you mean robot.limits.turn?)'],
    [
      'robot: {limits: {trun: 1}}',
      'farpoint.yaml:1: robot.limits.trun is not an option (did you mean robot.limits.turn?)',
    ],
    [
      'robot: {limist: {turn: 1}}',
      'farpoint.yaml:1: robot.limist is not an option (did you mean robot.limits?)',
    ],
    [
      'robot: {logLevel: info}',
      'farpoint.yaml:1: robot.logLevel is not an option (did you mean robot.log.level?)',
    ],
    ['robot: {limits: 3}', 'farpoint.yaml:1: robot.limits must be a mapping from option to value'],
    [
      'robot:\n  topics:\n    - topic: /a\n      moist: 1\n',
      'farpoint.yaml:4: robot.topics.0.moist is not a key here (did you mean most?), not 1',
    ],
    [
      'robot:\n  topics:\n    - topic: /a\n      most: fast\n',
      'farpoint.yaml:4: robot.topics.0.most must be a number, not "fast"',
    ],
    ['robot:\n  topics:\n    - most: 1\n', 'farpoint.yaml:3: robot.topics.0.topic is missing: must be text'],
    [
      'robot:\n  topics: [&a {topic: x, most: 900}, *a]',
      /2: robot.topics.0.most must be at most 100, not 900\n.*2: robot.topics.1.most/,
    ],
    ['robot:\n  a: [\n', /^farpoint\.yaml:3: not valid YAML: /],
    ['robot: {port: 1, port: 2}', /^farpoint.yaml:1: not valid YAML: Map keys must be unique/],
  ])('refuses %j by name', (text, message) => {
    if (typeof message === 'string') expect(mistake(file(text))).toBe(message);
    else expect(mistake(file(text))).toMatch(message);
  });

  test('every mistake in flags, environment and file is reported at once, typed', () => {
    const file = 'robto: {}\nrobot:\n  port: no\n  brake: true\n  limits:\n    turn: -1\n';
    try {
      resolve({
        argv: ['--max-speed', '9'],
        env: { FARPOINT_ROBOT_SOURCE: 'bag', FARPOINT_TOKEN: 'short' },
        files: { 'farpoint.yaml': file },
      });
      expect.unreachable();
    } catch (error) {
      expect(error).toBeInstanceOf(OptionsError);
      expect((error as OptionsError).mistakes).toMatchObject([
        { file: 'farpoint.yaml', line: 1, key: 'robto' },
        {
          file: 'farpoint.yaml',
          line: 4,
          key: 'robot.brake',
          detail: 'is not an option (did you mean robot.brakes?)',
        },
        { file: 'farpoint.yaml', line: 3, key: 'robot.port', found: '"no"' },
        { key: '--max-speed', found: '"9"', detail: 'must be a number from 0 to 2' },
        { key: 'FARPOINT_TOKEN' },
        { key: 'FARPOINT_ROBOT_SOURCE', found: '"bag"', detail: 'must be one of sim, shm' },
        { file: 'farpoint.yaml', line: 6, key: 'robot.limits.turn', found: '-1' },
      ]);
      expect((error as OptionsError).message).not.toContain('short');
    }
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
    [file('robot: {source: rosbag}'), 'farpoint.yaml:1: robot.source must be one of sim, shm, not "rosbag"'],
    [file('robot: {cameras: [a, []]}'), 'farpoint.yaml:1: robot.cameras.1 must be text, not []'],
    [file('robot: {prot: 1}'), 'farpoint.yaml:1: robot.prot is not an option (did you mean robot.port?)'],
    [
      file('robto: {}'),
      'farpoint.yaml:1: robto is not a section (did you mean robot?); the sections are robot, signaling, issuer, bridge, web, link',
    ],
    [file('[1]'), 'farpoint.yaml:1: must be a mapping from program to options'],
    [file('robot: 7'), 'farpoint.yaml:1: robot must be a mapping from option to value'],
    [{ argv: ['--config', 'nix.yaml'] }, '--config names a file that does not exist: nix.yaml'],
    [{ env: { FARPOINT_CONFIG: 'n' } }, 'FARPOINT_CONFIG names a file that does not exist: n'],
    [{ argv: ['--prot', '1'] }, "command line: unknown option '--prot' (Did you mean --port?)"],
    [{ argv: ['--port'] }, "command line: option '--port <PORT>' argument missing"],
    [{ env: { FARPOINT_TOKEN: 'short' } }, 'FARPOINT_TOKEN must be 8–4096 characters long'],
  ])('%j', (input, message) => {
    expect(mistake(input)).toBe(message);
  });

  test('refuses positional arguments', () => {
    expect(mistake({ argv: ['extra'] })).toMatch(/^command line: too many arguments/);
  });

  test('any command line and any file either resolve or are refused with an OptionsError', () => {
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
  expect(text).toContain('env: FARPOINT_ROBOT_TURN, file: limits.turn)');
  expect(text).toContain('token (env: FARPOINT_TOKEN)');
  expect(resolve({ argv: ['--version'] })).toEqual({ action: 'print', text: 'farpoint-robot 1.2.3\n' });
});

describe('help of a program with many options', () => {
  const speed = defineOption({ schema: schema.text(), default: '', argument: 'MPS', help: 'limit' });
  const turn = defineOption({ schema: schema.text(), default: '', argument: 'RAD', help: 'limit' });
  const record = defineOption({ schema: schema.boolean(), default: false, help: 'record' });
  const groups = { Wheels: { speed, turn }, Files: { record } };
  const program = defineProgram({
    name: 'farpoint-robot',
    summary: 'Drives.',
    version: '1.2.3',
    section: 'robot',
    options: mergeGroups(groups),
    groups,
    basics: ['speed', 'logLevel'],
  });
  const help = (...argv: string[]) => {
    const resolved = resolveOptions(program, { argv, env: {}, readFile: () => null });
    return resolved.action === 'print' ? resolved.text : '';
  };
  const flagsIn = (text: string) => text.match(/^ {2}--[a-z-]+/gm)?.map((flag) => flag.trim());

  test.each(['--help', '-h'])('%s shows the basic ones, and how to see the others', (flag) => {
    expect(flagsIn(help(flag))).toEqual(['--version', '--speed', '--log-level']);
    expect(help(flag)).toContain('These are 2 of 6 options. `farpoint-robot --help all` lists them all');
  });

  test('--help all shows all of them, by group', () => {
    const all = help('--help', 'all');
    expect(flagsIn(all)).toEqual([
      '--version',
      '--speed',
      '--turn',
      '--record',
      '--config',
      '--log-level',
      '--log-format',
    ]);
    expect(all.match(/^\S.*:$/gm)).toEqual(['Options:', 'Wheels:', 'Files:', 'Configuration and log:']);
  });

  test('no option is in two groups', () => {
    expect(() => mergeGroups({ Wheels: { speed }, Files: { speed: { ...speed } } })).toThrow('option speed');
  });
});

describe('text in the file is taken as it is written', () => {
  const of = (lines: string) => run({ files: { 'farpoint.yaml': `robot:\n${lines}` } }).values;

  test.each(['00123456', '12345678901234567890123', '1e0000010', '0x1F1F1F1F', '1.50000000', '+12345678'])(
    '%s',
    (token) => {
      expect(of(`  token: ${token}\n`).token).toBe(token);
      expect(of(`  token: &a ${token}\n`).token).toBe(token);
      expect(of(`  token: "${token}"\n`).token).toBe(token);
    },
  );

  test('in lists, too; numbers and switches are numbers and switches', () => {
    const values = of(
      '  cameras: [007, 1.0, true, a]\n  port: 0x1F\n  maxSpeed: 1.50\n  record: true\n  limits:\n    turn: 1e0\n',
    );
    expect(values).toMatchObject({
      cameras: ['007', '1.0', 'true', 'a'],
      port: 31,
      maxSpeed: 1.5,
      record: true,
      turn: 1,
    });
  });
});
