import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { resolveOptions } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it } from 'vitest';
import { parse } from 'yaml';
import * as z from 'zod';
import { robotProgram } from '../options/robot-program.ts';
import { SOURCE_KINDS } from '../options/source.ts';
import { init, robotTemplate } from './init.ts';

const folder = useFolder();

interface JsonSchema {
  properties?: Record<string, JsonSchema>;
  description?: string;
}

/** Runs `init`. @returns what it wrote, and its exit code */
function run(...argv: string[]) {
  let out = '';
  let errors = '';
  const code = init(argv, {
    stdout: { write: (text) => (out += text) },
    stderr: { write: (text) => (errors += text) },
  });
  return { code, out, errors };
}

/** The values that the robot reads from a file with this text. */
function values(text: string | null): Record<string, unknown> {
  const resolved = resolveOptions(robotProgram, { argv: [], env: {}, readFile: () => text });
  if (resolved.action !== 'run') throw new Error('printed');
  return resolved.values;
}

/** Enables every `#key:` line. */
const uncommented = (text: string) => text.replaceAll(/^( *)#(\w+:)/gm, '$1$2');
const defaults = values(null);

describe('the file that init writes', () => {
  it('gives the defaults, both as it is and with every line enabled', () => {
    const text = robotTemplate('sim');
    expect(values(text)).toEqual(defaults);
    expect(uncommented(text)).not.toBe(text);
    expect(values(uncommented(text))).toEqual(defaults);
  });

  it('turns the audit log on if it is given a file', () => {
    expect(values(run('--audit', '/var/lib/farpoint/audit.jsonl', '--output', '-').out)).toEqual({
      ...defaults,
      auditLog: '/var/lib/farpoint/audit.jsonl',
    });
  });

  it.each(SOURCE_KINDS)('is accepted for the source %s', (source) => {
    const text = robotTemplate(source);
    expect(values(text)).toMatchObject({ source });
    expect(values(uncommented(text))).toEqual(values(text));
  });

  it('has every option of its source, each explained', () => {
    const lines = robotTemplate('shm').split('\n');
    for (const key of ['url', 'token', 'shmOwner', 'maxLinear', 'iceServers', 'topics', 'port', 'level']) {
      const index = lines.findIndex((line) => new RegExp(`^ +#?${key}:`).test(line));
      expect(lines[index - 1], key).toMatch(/^ +# \S/);
    }
    expect(Math.max(...lines.map((line) => line.length))).toBeLessThan(125);
  });
});

describe('the schema that init writes', () => {
  const schema = JSON.parse(run('--schema', '--output', '-').out) as JsonSchema;
  const accepts = (text: string) => z.fromJSONSchema(schema as never).safeParse(parse(text)).success;

  it.each(SOURCE_KINDS)('accepts the file that init writes for %s', (source) => {
    const text = robotTemplate(source);
    expect(accepts(text)).toBe(true);
    expect(accepts(uncommented(text))).toBe(true);
  });

  it.each([
    ['a key that nobody knows', 'robot: { limits: { maxLinaer: 1 } }'],
    ['a value that is none of the choices', 'robot: { source: { kind: camera } }'],
    ['a number out of its range', 'robot: { limits: { watchdogMs: 20 } }'],
    ['a text where a number belongs', 'robot: { stream: { bitrateMbps: much } }'],
    ['a fraction where a whole number belongs', 'robot: { limits: { maxOperators: 1.5 } }'],
    ['a camera without a source', 'robot: { videos: [{ name: Front }] }'],
    ['a section of no program', 'robots: { id: rover }'],
  ])('refuses %s, as the robot does', (_, text) => {
    expect(accepts(text)).toBe(false);
    expect(() => values(text)).toThrow();
  });

  it('explains each key, and says no secret', () => {
    const keys = (node: JsonSchema): JsonSchema[] =>
      Object.values(node.properties ?? {}).flatMap((each) =>
        each.description === undefined ? keys(each) : [each],
      );
    const described = keys(schema.properties?.robot ?? {});
    expect(described.length).toBeGreaterThan(100);
    expect(described.filter(({ description }) => (description?.length ?? 0) < 10)).toEqual([]);
  });
});

describe('init', () => {
  it('writes a file once, and overwrites it only with --force', () => {
    const path = join(folder, 'robot.yaml');
    expect(run('--output', path)).toMatchObject({ code: 0, errors: '' });
    expect(readFileSync(path, 'utf8')).toBe(robotTemplate('sim'));
    expect(statSync(path).mode & 0o007).toBe(0);
    writeFileSync(path, 'mine');
    expect(run('--output', path)).toEqual({
      code: 1,
      out: '',
      errors: `farpoint-robot init: ${path} already exists; --force replaces it\n`,
    });
    expect(readFileSync(path, 'utf8')).toBe('mine');
    expect(run('--output', path, '--force', '--source', 'shm').out).toContain(`doctor --config ${path}`);
    expect(readFileSync(path, 'utf8')).toBe(robotTemplate('shm'));
  });

  it('writes to standard output', () => {
    expect(run('--output', '-', '--source', 'recording')).toEqual({
      code: 0,
      out: robotTemplate('recording'),
      errors: '',
    });
  });

  it.each([
    [['--source', 'kinect'], 2, /--source must be one of sim, .*, not "kinect"/],
    [['--froce'], 2, /froce/],
    [['extra'], 2, /extra/],
    [['--output', '/nowhere/at/all.yaml'], 1, /cannot be written: ENOENT/],
  ])('refuses %j', (argv, code, message) => {
    const refused = run(...argv);
    expect(refused.code).toBe(code);
    expect(refused.errors).toMatch(message);
  });
});
