/** Every option of the service, and of its commands, that names a file to read. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { OptionsError } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { uselessFiles } from '@farpoint/service/testing/useless-files';
import { describe, expect, it } from 'vitest';
import { grantCommand } from './grant/grant-command.ts';
import { defaultOptions, type SignalingOptions } from './options.ts';
import { RevocationFiles } from './revocation-files.ts';
import { readFiles } from './service-files.ts';

const folder = useFolder();
const useless = uselessFiles();

function file(name: string, text: string): string {
  const path = join(folder, name);
  writeFileSync(path, text);
  return path;
}

function refusal(options: Partial<SignalingOptions>): string {
  try {
    readFiles({ ...defaultOptions(), ...options });
  } catch (error) {
    if (error instanceof OptionsError) return error.message;
    throw error;
  }
  throw new Error('it is taken');
}

const other = file('other', 'text');
const options: [string, (path: string) => Partial<SignalingOptions>][] = [
  ['--robot-tokens', (path) => ({ robotTokens: path })],
  ['--operator-tokens', (path) => ({ operatorTokens: path })],
  ['--tls-cert', (path) => ({ tlsCert: path, tlsKey: other })],
  ['--tls-key', (path) => ({ tlsCert: other, tlsKey: path })],
];
describe.each(options)('%s', (flag, of) => {
  it.each(useless)('refuses a file that is $what', ({ path, words }) => {
    const message = refusal(of(path));
    expect(message.startsWith(`${flag} `)).toBe(true);
    expect(message).toContain(path);
    expect(message).toContain(words);
  });
});

it('takes tokens after a byte order mark', () => {
  const { robots } = readFiles({
    ...defaultOptions(),
    robotTokens: file('marked', '\uFEFFkitchen: abc\n'),
  });
  expect(robots.allows('abc', 'kitchen')).toBe(true);
});

it.each(useless)('says of a list of revoked grants that is $what what is wrong', async ({ path, words }) => {
  const told: string[] = [];
  const log = { info: () => {}, warn: ({ detail }: { detail: string }) => told.push(detail) } as never;
  const files = new RevocationFiles({ paths: [path], log, onChange: () => {} });
  await files.start();
  files.close();
  expect(told).toEqual([expect.stringContaining(path)]);
  if (words !== 'is a folder') expect(told[0]).toContain(words);
});

const ada = ['issue', '--name', 'Ada', '--role', 'drive', '--robots', '*'];
const commands: [string, (path: string) => string[]][] = [
  ['--key', (path) => [...ada, '--with-key', '--key', path]],
  ['--for', (path) => [...ada, '--for', path]],
  ['--key', (path) => ['revoke', '--list', join(folder, 'list'), '--id', 'x', '--key', path]],
];
describe.each(commands)('grant, %s', (flag, argv) => {
  it.each(useless)('refuses a file that is $what', async ({ path, words }) => {
    const err: string[] = [];
    const rim = {
      stdout: { write: () => {} },
      stderr: { write: (text: string) => err.push(text) },
      now: () => 1_800_000_000_000,
    };
    expect(await grantCommand(argv(path), rim as never)).toBe(1);
    expect(err.join('')).toContain(flag);
    expect(err.join('')).toContain(path);
    expect(err.join('')).toContain(words);
  });
});
