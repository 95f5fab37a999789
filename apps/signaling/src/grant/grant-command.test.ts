import { readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  decodeTicket,
  KnownRevocations,
  keyThumbprint,
  makeOperatorKey,
  parseGrantKeys,
  readGrant,
  readRevocations,
  verifyGrant,
  verifyRevocations,
} from '@farpoint/grants';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, expect, it } from 'vitest';
import { grantCommand } from './grant-command.ts';

const NOW = 1_800_000_000_000;
let folder: string;
beforeEach(() => {
  folder = testFolder();
});

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
/** Makes a key. @returns where it and the public one are */
async function keygen() {
  const made = files();
  await run(['keygen', ...flagsOf(made)]);
  return made;
}
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
  const { key, keys } = await keygen();
  const { publicJwk } = await makeOperatorKey();
  const file = join(folder, 'operator.json');
  writeFileSync(file, JSON.stringify({ ...publicJwk, kid: 'mine', ext: true }));
  const jkt = await keyThumbprint(publicJwk);
  const trusted = await parseGrantKeys(readFileSync(keys, 'utf8'));
  for (const each of [jkt, file]) {
    const { out, err } = await run(['issue', ...ada, '--for', each, '--days', '1.5', '--key', key]);
    expect(err).toContain('Ada may drive kitchen-*, hall-1 until');
    const grant = await verifyGrant(out.trim(), { keys: trusted, robot: 'hall-1', nowS: NOW / 1000 });
    expect(grant).toMatchObject({ operatorKey: jkt, subject: 'Ada', expiresAtS: NOW / 1000 + 129_600 });
  }
});

it('issues and revokes grants for a thumbprint and an id that begin with a dash', async () => {
  const { key } = await keygen();
  const dashed = `-${'a'.repeat(42)}`;
  const { out, status } = await run(['issue', ...ada, '--for', dashed, '--key', key]);
  expect(status).toBe(0);
  expect(readGrant(out.trim()).claims.cnf.jkt).toBe(dashed);
  const list = join(folder, 'revocations');
  expect(await run(['revoke', '--list', list, '--key', key, '--id', '-b_c'])).toMatchObject({ status: 0 });
});

it('names robots’ keys for the operator', async () => {
  const { key } = await keygen();
  const thumbprint = 'A'.repeat(43);
  const issue = (...robotKeys: string[]) =>
    run([
      ...['issue', ...ada, '--with-key', '--key', key],
      ...robotKeys.flatMap((each) => ['--robot-key', each]),
    ]);
  const { out } = await issue(`hall-1=${thumbprint}`, `kitchen-1=${'b'.repeat(43)}`);
  expect(readGrant(decodeTicket(out.trim())?.grant ?? '').claims.robotKeys).toEqual({
    ...{ 'hall-1': thumbprint, 'kitchen-1': 'b'.repeat(43) },
  });
  expect(await run(['show', out.trim()])).toMatchObject({
    out: expect.stringContaining(`robot key  hall-1 ${thumbprint}\n`),
  });
  for (const wrong of ['hall-1', 'hall-1=short', `=${thumbprint}`, `Hall 1=${thumbprint}`])
    expect(await issue(wrong)).toMatchObject({ status: 2, err: expect.stringContaining('--robot-key') });
});

it('a ticket holds the key that its grant names', async () => {
  const { key, keys } = await keygen();
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
  const { key, keys } = await keygen();
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
  [['issue', ...ada, '--for', '--days', '1'], 2, "'--for'"],
  [['keygen', '--alg', 'HS256'], 2, '--alg must be one of EdDSA, ES256'],
  [['show'], 2, 'needs one grant'],
  [['show', 'a.b.c'], 1, 'neither a grant nor a ticket'],
  [['constructor'], 2, 'no command constructor'],
  [['revoke', '--id', 'x'], 2, 'needs --list'],
  [['revoke', '--list', 'l'], 2, 'needs --id or --subject'],
  [['revoke', '--list', 'l', '--id', 'a b'], 2, '--id a b is not a grant’s id'],
  [['revoke', '--list', 'l', '--subject', ''], 2, '--subject and --issuer must be'],
  [['revoke', '--list', 'l', '--id', 'x', '--days', '-1'], 2, '--days'],
  [['revoke', '--list', 'l', '--id', 'x', '--key', '/nowhere/key'], 1, '--key cannot be read'],
] as const)('%j: exit status %i', async (args, status, message) => {
  expect(await run([...args])).toMatchObject({ status, err: expect.stringContaining(message), out: '' });
});

it('revokes grants and persons, in a list that grows and that every robot can verify', async () => {
  const { key, keys } = files();
  const list = join(folder, 'revoked.jws');
  await run(['keygen', ...flagsOf({ key, keys })]);
  const trusted = await parseGrantKeys(readFileSync(keys, 'utf8'));
  const issued = async (name: string, nowMs = NOW) => {
    const { out } = await run(['issue', ...ada.slice(2), '--name', name, '--with-key', '--key', key], nowMs);
    const { grant = '' } = decodeTicket(out.trim()) ?? {};
    return verifyGrant(grant, { keys: trusted, robot: 'hall-1', nowS: nowMs / 1000 });
  };
  const [one, two, eve] = [await issued('Ada'), await issued('Ada'), await issued('Eve')];
  const revoke = (...args: string[]) => run(['revoke', '--list', list, '--key', key, ...args], NOW + 60_000);
  expect(await revoke(`--id=${one.id}`)).toMatchObject({ status: 0, out: expect.stringContaining('Made') });
  const now = async () => {
    const { keyId, payload } = await verifyRevocations(readFileSync(list, 'utf8').trim(), trusted);
    const known = new KnownRevocations(keyId);
    known.add(payload, NOW / 1000);
    return known;
  };
  const first = await now();
  expect([one, two, eve].map((each) => first.revokes(each, NOW / 1000))).toEqual([true, false, false]);
  expect(await revoke('--subject', 'Eve', '--subject', 'Bob')).toMatchObject({
    status: 0,
    out: expect.stringMatching(
      /grants to Eve issued before .*\nrevoked: grants to Bob .*\nExtended .* 3 in all/,
    ),
  });
  const second = await now();
  expect(second.sequence).toBeGreaterThan(first.sequence);
  const again = await issued('Eve', NOW + 61_000);
  expect([one, two, eve, again].map((each) => second.revokes(each, NOW / 1000))).toEqual([
    true,
    false,
    true,
    false,
  ]);
  expect(readdirSync(folder).sort()).toEqual(['key.json', 'keys.json', 'revoked.jws']);
});

it('a list belongs to one key, and to nothing else', async () => {
  const { key, keys } = files();
  const [second, list] = [join(folder, 'second.json'), join(folder, 'revoked.jws')];
  await run(['keygen', ...flagsOf({ key, keys })]);
  await run(['keygen', ...flagsOf({ key: second, keys })]);
  await run(['revoke', '--list', list, '--id', 'g1', '--key', key]);
  const before = readFileSync(list, 'utf8');
  const { keyId } = readRevocations(before.trim());
  const other = await run(['revoke', '--list', list, '--id', 'g2', '--key', second]);
  expect(other).toMatchObject({ status: 1, err: expect.stringContaining('signed by another key than') });
  expect(readRevocations(readFileSync(list, 'utf8').trim()).keyId).toBe(keyId);
  const wrong = await run(['revoke', '--list', keys, '--id', 'g2', '--key', key]);
  expect(wrong).toMatchObject({ status: 1, err: expect.stringContaining('is not a list of revocations') });
  const many = Array.from({ length: 1025 }, (_, i) => ['--id', `g${i}`]).flat();
  const full = await run(['revoke', '--list', list, '--key', key, ...many]);
  expect(full).toMatchObject({ status: 1, err: expect.stringContaining('is full') });
  // A command that runs at the same time must not be undone.
  writeFileSync(`${list}.new`, '');
  const busy = await run(['revoke', '--list', list, '--id', 'g2', '--key', key]);
  expect(busy).toMatchObject({ status: 1, err: expect.stringContaining('another command is writing it') });
  rmSync(`${list}.new`);
  expect(readFileSync(list, 'utf8')).toBe(before);
  expect(await run(['revoke', '--list', list, '--id', 'g2', '--key', key])).toMatchObject({ status: 0 });
});

it('refuses a private key where the public one is asked for', async () => {
  const { key, keys } = await keygen();
  expect(await run(['issue', ...ada, '--for', key])).toMatchObject({
    status: 2,
    err: expect.stringContaining('is a private key'),
  });
  expect(await run(['issue', ...ada, '--with-key', '--key', keys])).toMatchObject({ status: 1 });
});

it.each([
  [[]],
  [['--help']],
  [['keygen', '--help']],
  [['issue', '-h']],
  [['show', '--help']],
  [['revoke', '-h']],
])('%j: help', async (args) => {
  const { status, out } = await run(args);
  expect([status, out.startsWith('farpoint-signaling grant')]).toEqual([0, true]);
});
