/** The program as it is deployed: one file, and what it says about its options. */
import { spawnSync } from 'node:child_process';
import { readdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { makeSigningKey } from '@farpoint/grants';
import { LoggingProcess } from '@farpoint/service/testing';
import { useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, expect, it } from 'vitest';

const folder = useFolder();
const bundle = join(folder, 'issuer.mjs');

beforeAll(async () => {
  const built = spawnSync(process.execPath, [resolve(import.meta.dirname, '../build.ts'), bundle]);
  if (built.status !== 0) throw new Error(built.stderr.toString());
  writeFileSync(join(folder, 'grant-key.json'), JSON.stringify((await makeSigningKey()).secretJwk), {
    mode: 0o644,
  });
}, 60_000);

const start = (args: readonly string[]) =>
  new LoggingProcess(bundle, [...args], { cwd: folder, env: { PATH: process.env.PATH } });

const rule = { claim: 'groups', value: 'drivers', role: 'drive', robots: ['*'] };
const enough = [
  ...[
    '--url',
    'https://issuer.example',
    '--pages',
    'https://teleop.example/',
    '--port',
    '0',
    '--admin-port',
    '0',
  ],
  ...['--provider', 'https://login.example', '--client-id', 'farpoint'],
];
const rules = (...list: object[]) => ['--rules', JSON.stringify(list)];

it('runs alone, warns of a key that others may read, and ends at SIGTERM with 0', async () => {
  expect(readdirSync(folder).sort()).toEqual(['grant-key.json', 'issuer.mjs']);
  const issuer = start([...enough, ...rules(rule)]);
  await issuer.logged(/private key: chmod 600/);
  const { port } = await issuer.logged('listening');
  const { port: adminPort } = await issuer.logged('health and metrics');
  expect((await fetch(`http://127.0.0.1:${String(adminPort)}/healthz`)).status).toBe(200);
  const nothing = await fetch(`http://127.0.0.1:${String(port)}/`);
  expect([nothing.status, nothing.headers.get('strict-transport-security')]).toEqual([
    404,
    'max-age=31536000',
  ]);
  issuer.child.kill('SIGTERM');
  expect(await issuer.exited).toBe(0);
});

it.each<[string, string[], RegExp]>([
  [
    'all that is missing',
    [],
    /--url.* must be given\n.*--provider.* must be given\n.*--client-id.* must be given\n.*--pages.*\n.*--rules/,
  ],
  [
    'a page that is not protected',
    [...enough, ...rules(rule), '--pages', 'http://teleop.example/'],
    /--pages.*must be an https address/,
  ],
  [
    'a role that there is not',
    [...enough, ...rules({ ...rule, role: 'admin' })],
    /role must be one of watch, drive, supervise/,
  ],
  ['rules that are not JSON', [...enough, '--rules', 'drivers'], /--rules must be a list of/],
  [
    'a file that is not a key',
    [...enough, ...rules(rule), '--key', 'issuer.mjs'],
    /--key: issuer\.mjs is not JSON/,
  ],
  [
    'a file that is not there',
    [...enough, ...rules(rule), '--key', 'nix'],
    /--key cannot be read: nix does not exist/,
  ],
  [
    'a scope without openid',
    [...enough, ...rules(rule), '--scope', 'profile'],
    /--scope must contain openid/,
  ],
  [
    'a grant that robots do not read',
    [
      ...enough,
      ...rules({ ...rule, robots: Array.from({ length: 32 }, (_, i) => `${'x'.repeat(60)}-${i}`) }),
      '--robot-keys',
      JSON.stringify(
        Object.fromEntries(Array.from({ length: 32 }, (_, i) => [`${'x'.repeat(60)}-${i}`, 'k'.repeat(43)])),
      ),
    ],
    /rule 1 makes grants of \d+ characters/,
  ],
])('says %s, with exit code 2', async (_, args, said) => {
  const issuer = start(args);
  expect(await issuer.exited).toBe(2);
  expect(issuer.errors).toMatch(said);
});
