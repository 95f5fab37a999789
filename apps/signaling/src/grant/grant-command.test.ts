import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { decodeTicket, keyThumbprint, makeOperatorKey, parseGrantKeys, verifyGrant } from '@farpoint/grants';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { grantCommand } from './grant-command.ts';

const NOW = 1_800_000_000_000;
let folder: string;
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'farpoint-grant-'));
});
afterEach(() => rmSync(folder, { recursive: true }));

async function run(args: string[], nowMs = NOW) {
  const [out, err]: [string[], string[]] = [[], []];
  const rim = {
    stdout: { write: (text: string) => out.push(text) },
    stderr: { write: (text: string) => err.push(text) },
    now: () => nowMs,
  };
  const status = await grantCommand(args, rim);
  return { status, out: out.join(''), err: err.join('') };
}

const files = () => ({ key: join(folder, 'key.json'), keys: join(folder, 'keys.json') });
const flagsOf = ({ key, keys }: ReturnType<typeof files>) => ['--key', key, '--keys', keys];
const ada = ['--name', 'Ada', '--role', 'drive', '--robots', 'kitchen-*, hall-1'];

it('makes a key that only its owner reads, and never overwrites one', async () => {
  const { key, keys } = files();
  expect(await run(['keygen', ...flagsOf({ key, keys })])).toMatchObject({ status: 0 });
  expect(statSync(key).mode & 0o777).toBe(0o600);
  expect(readFileSync(keys, 'utf8')).not.toContain('"d"');
  const before = readFileSync(key, 'utf8');
  const again = await run(['keygen', ...flagsOf({ key, keys })]);
  expect(again).toMatchObject({ status: 1, err: expect.stringContaining('never overwritten') });
  expect(readFileSync(key, 'utf8')).toBe(before);
});

it('adds the second key to the public ones, so that grants of both are valid', async () => {
  const { key, keys } = files();
  const second = join(folder, 'second.json');
  await run(['keygen', ...flagsOf({ key, keys })]);
  await run(['keygen', '--alg', 'ES256', ...flagsOf({ key: second, keys })]);
  for (const each of [key, second]) {
    const { out, status } = await run(['issue', ...ada, '--with-key', '--key', each]);
    expect(status).toBe(0);
    expect(await run(['show', out.trim(), '--keys', keys, '--robot', 'hall-1'])).toMatchObject({ status: 0 });
  }
});

it('issues a grant for a thumbprint and for a public key in a file', async () => {
  const { key, keys } = files();
  await run(['keygen', ...flagsOf({ key, keys })]);
  const { publicJwk } = await makeOperatorKey();
  const file = join(folder, 'operator.json');
  writeFileSync(file, JSON.stringify({ ...publicJwk, kid: 'mine', ext: true }));
  const jkt = await keyThumbprint(publicJwk);
  const trusted = await parseGrantKeys(readFileSync(keys, 'utf8'));
  for (const each of [jkt, file]) {
    const { out, err } = await run(['issue', ...ada, `--for=${each}`, '--days', '1.5', '--key', key]);
    expect(err).toContain('Ada may drive kitchen-*, hall-1 until');
    const grant = await verifyGrant(out.trim(), { keys: trusted, robot: 'hall-1', nowS: NOW / 1000 });
    expect(grant).toMatchObject({ operatorKey: jkt, subject: 'Ada', expiresAtS: NOW / 1000 + 129_600 });
  }
});

it('a ticket holds the key that its grant names', async () => {
  const { key, keys } = files();
  await run(['keygen', ...flagsOf({ key, keys })]);
  const { out } = await run(['issue', ...ada, '--with-key', '--key', key]);
  expect(decodeTicket(out.trim())).not.toBeNull();
  const file = join(folder, 'ticket');
  writeFileSync(file, out);
  expect(await run(['show', file, '--keys', keys])).toMatchObject({
    status: 0,
    out: expect.stringMatching(/name +Ada\n[\s\S]*role +drive\n[\s\S]*\nvalid\n$/),
  });
});

it('says why a grant is not valid', async () => {
  const { key, keys } = files();
  await run(['keygen', ...flagsOf({ key, keys })]);
  const grant = (await run(['issue', ...ada, '--with-key', '--key', key])).out.trim();
  const later = NOW + 40 * 86_400_000;
  expect((await run(['show', grant, '--keys', keys], later)).out).toContain('not valid: grant-expired');
  expect((await run(['show', grant], later)).out).toContain('not valid: it has expired');
  expect((await run(['show', grant])).out).toContain('the signature is not checked');
  expect((await run(['show', grant, '--keys', keys, '--robot', 'cellar'])).out).toContain(
    'grant-other-robot',
  );
  const others = { key: join(folder, 'o.json'), keys: join(folder, 'os.json') };
  await run(['keygen', ...flagsOf(others)]);
  expect(await run(['show', grant, '--keys', others.keys])).toMatchObject({
    status: 1,
    out: expect.stringContaining('not valid: grant-untrusted'),
  });
});

it.each([
  [['issue', '--robots', '*', '--role', 'drive', '--with-key'], 2, 'needs --name'],
  [['issue', ...ada], 2, 'needs either --for KEY or --with-key'],
  [['issue', ...ada, '--with-key', '--for', 'x'], 2, 'needs either'],
  [['issue', ...ada, '--with-key', '--days', '0'], 2, '--days must be'],
  [['issue', ...ada, '--with-key', '--role', 'root'], 2, '--role must be watch'],
  [['issue', ...ada, '--with-key', '--robots', 'Kitchen'], 2, '--robots must be'],
  [['issue', ...ada, '--with-key', '--key', '/nowhere/key'], 1, '--key cannot be read'],
  [['issue', ...ada, '--for', '/nowhere/key'], 1, '--for cannot be read'],
  [['issue', '--nmae', 'x'], 2, "'--nmae'"],
  [['keygen', '--alg', 'HS256'], 2, '--alg must be one of EdDSA, ES256'],
  [['show'], 2, 'needs one grant'],
  [['show', 'a.b.c'], 1, 'neither a grant nor a ticket'],
  [['constructor'], 2, 'no command constructor'],
] as const)('%j: exit status %i', async (args, status, message) => {
  expect(await run([...args])).toMatchObject({ status, err: expect.stringContaining(message), out: '' });
});

it('refuses a private key where the public one is asked for', async () => {
  const { key, keys } = files();
  await run(['keygen', ...flagsOf({ key, keys })]);
  expect(await run(['issue', ...ada, '--for', key])).toMatchObject({
    status: 2,
    err: expect.stringContaining('is a private key'),
  });
  expect(await run(['issue', ...ada, '--with-key', '--key', keys])).toMatchObject({ status: 1 });
});

it.each([[[]], [['--help']], [['keygen', '--help']], [['issue', '-h']], [['show', '--help']]])(
  '%j: help',
  async (args) => {
    const { status, out } = await run(args);
    expect([status, out.startsWith('farpoint-signaling grant')]).toEqual([0, true]);
  },
);
