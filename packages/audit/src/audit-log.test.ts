import {
  appendFileSync,
  chmodSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  renameSync,
  rmSync,
  statSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { type FileHandle, open as openFile } from 'node:fs/promises';
import { join } from 'node:path';
import { testFolder } from '@farpoint/service/testing/folder';
import { beforeEach, expect, it, vi } from 'vitest';
import { auditCommand } from './audit-command.ts';
import { AuditFile } from './audit-file.ts';
import { AuditLog, type AuditLogOptions } from './audit-log.ts';
import { chainOf, EVENTS } from './testing/chain.ts';
import { verifyFiles } from './verify-files.ts';

let folder: string;
let path: string;
beforeEach(() => {
  folder = testFolder();
  path = join(folder, 'audit.jsonl');
});

const setUp = (given: Partial<AuditLogOptions> = {}) => {
  const onFault = vi.fn();
  const onDamage = vi.fn();
  const options = {
    path,
    maxBytes: 1e6,
    robot: 'r1',
    nowMs: () => 1e12,
    clockMs: () => 0,
    onFault,
    onDamage,
  };
  return { onFault, onDamage, options: { ...options, ...given } };
};
const open = (given: Partial<AuditLogOptions> = {}) => AuditLog.open(setUp(given).options);
const write = async (events = EVENTS, given: Partial<AuditLogOptions> = {}) => {
  const log = await open(given);
  for (const event of events) log.record(event);
  await log.close();
};
const kinds = (file = path) =>
  readFileSync(file, 'utf8')
    .split('\n')
    .filter((line) => line.startsWith('{') && line.endsWith('}'))
    .map((line) => (JSON.parse(line) as { kind: string }).kind);
const verify = (...args: string[]) => {
  const said: string[] = [];
  const out = { write: (text: string) => said.push(text) };
  return {
    status: auditCommand('farpoint-robot', ['verify', ...args], { stdout: out, stderr: out }),
    said: said.join(''),
  };
};

it('goes on with the chain at the next start, in a file that only its owner reads', async () => {
  await write();
  await write();
  expect(verifyFiles([path])).toMatchObject({ entries: 10, first: { robot: 'r1' } });
  expect(statSync(path).mode & 0o777).toBe(0o600);
});

it('takes away the permissions of others', async () => {
  writeFileSync(path, '');
  chmodSync(path, 0o664);
  await write();
  expect(statSync(path).mode & 0o777).toBe(0o600);
});

it('begins a new file when one is full; the chain goes on, also after a start', async () => {
  for (let i = 0; i < 4; i++) await write(EVENTS, { maxBytes: 2000 });
  const files = readdirSync(folder).map((name) => join(folder, name));
  expect(files.map((file) => file.slice(path.length)).sort()).toEqual([
    '',
    '.000000000004',
    '.000000000009',
    '.000000000014',
  ]);
  for (const file of files) expect(statSync(file).size).toBeLessThan(2000);
  expect(verifyFiles(files)).toMatchObject({ entries: 20 });
  expect(verifyFiles(files.toReversed())).toMatchObject({ entries: 20 });
  rmSync(path);
  await write(EVENTS.slice(0, 1));
  expect(verifyFiles(files)).toMatchObject({ entries: 16 });
});

it('records what a crash has torn', async () => {
  await write();
  appendFileSync(path, '{"hash":"12');
  const { onDamage, options } = setUp();
  const log = await AuditLog.open(options);
  expect(onDamage).toHaveBeenCalledExactlyOnceWith({ kind: 'torn', bytes: 11 });
  log.record({ kind: 'started' });
  await log.close();
  expect(kinds().slice(-2)).toEqual(['torn-entry', 'started']);
  expect(verifyFiles([path])).toMatchObject({ entries: 7, torn: 1 });
});

it('sets a file aside that is no audit log, and keeps it', async () => {
  writeFileSync(path, 'my notes\n');
  const { onDamage, options } = setUp();
  await (await AuditLog.open(options)).close();
  expect(onDamage).toHaveBeenCalledExactlyOnceWith({ kind: 'set-aside', file: `${path}.damaged`, bytes: 9 });
  expect(readFileSync(`${path}.damaged`, 'utf8')).toBe('my notes\n');
  expect(kinds()).toEqual(['log-set-aside']);
  expect(verifyFiles([path])).toMatchObject({ entries: 1 });
});

it('refuses what is no file, and folders that do not exist', async () => {
  mkdirSync(path);
  await expect(open()).rejects.toThrow();
  rmSync(path, { recursive: true });
  symlinkSync(join(folder, 'elsewhere'), path);
  await expect(open()).rejects.toThrow();
  await expect(open({ path: join(folder, 'no', 'audit') })).rejects.toThrow();
});

it('follows when the file is moved away or written to by another program', async () => {
  const { onDamage, options } = setUp();
  const log = await AuditLog.open(options);
  const recorded = async (kind: 'reloaded' | 'stopped') => {
    log.record({ kind });
    await vi.waitFor(() => expect(kinds().at(-1)).toBe(kind));
  };
  await recorded('reloaded');
  renameSync(path, `${path}.old`);
  log.record({ kind: 'stopped' });
  await vi.waitFor(() => expect(kinds()).toEqual(['stopped']));
  appendFileSync(path, 'not ours\n');
  await recorded('reloaded');
  expect(onDamage).toHaveBeenCalledExactlyOnceWith({ kind: 'torn', bytes: 9 });
  await log.close();
  expect(verifyFiles([path, `${path}.old`])).toMatchObject({ entries: 4, torn: 1 });
});

it('bounds what a peer can make it write, and says how much it left out', async () => {
  const refused = (reason: string) => ({ kind: 'refused', details: { reason } }) as const;
  await write([
    ...Array.from({ length: 1000 }, () => refused('grant-expired')),
    refused('grant-missing'),
    ...Array.from({ length: 60 }, () => ({ kind: 'estop-latched' }) as const),
  ]);
  expect(kinds()).toHaveLength(102);
  const last = readFileSync(path, 'utf8').trimEnd().split('\n').at(-1)!;
  expect(JSON.parse(last)).toMatchObject({
    kind: 'entries-omitted',
    details: { 'refused:grant-expired': 950, 'estop-latched': 10 },
  });
});

it('a full disk stops nothing: it is said once, and the log goes on when there is room', async () => {
  const { onFault, onDamage, options } = setUp();
  const log = await AuditLog.open(options);
  const full = Object.assign(new Error('no space left on device'), { code: 'ENOSPC' });
  const append = vi.spyOn(AuditFile.prototype, 'append').mockImplementation((text) => {
    // As the system does it: as much as there is room for.
    appendFileSync(path, text.slice(0, text.indexOf('\n') + 20));
    return Promise.reject(full);
  });
  try {
    for (const event of EVENTS) log.record(event);
    await vi.waitFor(() => expect(onFault.mock.calls).toEqual([[full]]));
    for (let i = 0; i < 2000; i++) log.record({ kind: 'stopped' });
  } finally {
    append.mockRestore();
  }
  await log.close();
  expect(onFault.mock.calls).toEqual([[full], [null]]);
  expect(onDamage).toHaveBeenCalledExactlyOnceWith({ kind: 'torn', bytes: 19 });
  // The first entry was whole, and is not there twice.
  const all = ['started', 'torn-entry', 'session-began', 'lease-given', 'estop-latched'];
  expect(kinds().slice(0, 5)).toEqual(all);
  expect(verifyFiles([path])).toMatchObject({ torn: 1, entries: 5 + 1 + 49 + 1 });
});

it('takes back what a failed write has written', async () => {
  const { file, found } = await AuditFile.open(path, 1e6);
  await file.append('one\n');
  const handle = await openFile(path);
  const prototype = Object.getPrototypeOf(handle) as FileHandle;
  const sync = vi.spyOn(prototype, 'datasync').mockRejectedValueOnce(new Error('no space left on device'));
  await expect(file.append('two\n')).rejects.toThrow('no space');
  sync.mockRestore();
  expect(readFileSync(path, 'utf8')).toBe('one\n');
  expect(await file.isCurrent()).toBe(true);
  await file.append('three\n');
  expect(readFileSync(path, 'utf8')).toBe('one\nthree\n');
  expect(found.end.sequence).toBe(0);
  await handle.close();
  await file.close();
});

it('starts on a full disk, and writes when there is room', async () => {
  const { onFault, options } = setUp();
  const full = Object.assign(new Error('no space left on device'), { code: 'ENOSPC' });
  const opening = vi.spyOn(AuditFile, 'open').mockRejectedValueOnce(full);
  const log = await AuditLog.open(options).finally(() => opening.mockRestore());
  log.record({ kind: 'started' });
  await log.close();
  expect(onFault.mock.calls).toEqual([[full], [null]]);
  expect(kinds()).toEqual(['started']);
});

it('drops the oldest events when too many wait, and says how many', async () => {
  let clockMs = 0;
  const log = await open({ clockMs: () => (clockMs += 5000) });
  for (let i = 0; i < 1100; i++) log.record({ kind: 'reloaded', details: { i } });
  await log.close();
  const lines = readFileSync(path, 'utf8').trimEnd().split('\n');
  expect(lines).toHaveLength(1025);
  expect(JSON.parse(lines[0]!)).toMatchObject({ kind: 'entries-dropped', details: { count: 76 } });
  expect(JSON.parse(lines[1]!)).toMatchObject({ details: { i: 76 } });
  expect(verifyFiles([path])).toMatchObject({ entries: 1025 });
});

it('verify prints one line, and its exit status says the same', async () => {
  await write();
  expect(verify(path)).toEqual({
    status: 0,
    said: expect.stringMatching(/^as written: entries 0–4 \(5\), .*\n$/),
  });
  const hash = /last hash (\w+)/.exec(verify(path).said)?.[1] ?? '';
  expect(verify(path, '--contains', hash).status).toBe(0);
  const text = readFileSync(path, 'utf8');
  writeFileSync(path, text.replace('"by":"operator"', '"by":"robot"'));
  expect(verify(path)).toEqual({
    status: 1,
    said: `not as written (changed): ${path}, line 4: entry 3 is not what was written\n`,
  });
  writeFileSync(path, text.split('\n').slice(0, 4).join('\n'));
  expect(verify(path).status).toBe(0);
  expect(verify(path, '--contains', hash)).toMatchObject({
    status: 1,
    said: expect.stringContaining('missing'),
  });
  writeFileSync(path, chainOf(EVENTS).slice(1).join(''));
  expect(verify(path).status).toBe(1);
  expect(verify('--partial', path).status).toBe(0);
});

it('verify explains itself, and refuses mistakes', () => {
  expect(verify('--help')).toMatchObject({ status: 0, said: expect.stringContaining('--contains HASH') });
  expect(verify().status).toBe(2);
  expect(verify('a', 'a').status).toBe(2);
  expect(verify('--nonsense', path).status).toBe(2);
  expect(verify('--contains', 'x', path).status).toBe(2);
  expect(verify(path)).toEqual({ status: 1, said: expect.stringContaining('ENOENT') });
  const out = { write: () => true };
  expect(auditCommand('p', ['other'], { stdout: out, stderr: out })).toBe(2);
  expect(auditCommand('p', [], { stdout: out, stderr: out })).toBe(0);
});
