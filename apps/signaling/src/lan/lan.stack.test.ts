/** `--lan` over real sockets and TLS: the certificate, the page for it, and pairing. */
import { X509Certificate } from 'node:crypto';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { get, type RequestOptions, request } from 'node:https';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { makeSigningKey } from '@farpoint/grants';
import { signInAddress } from '@farpoint/protocol';
import { OptionsError, silentLogger } from '@farpoint/service';
import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import WebSocket from 'ws';
import { defaultOptions, type SignalingOptions } from '../options.ts';
import { type RunningSignaling, startSignaling } from '../server.ts';
import { type Lan, openLan } from './lan.ts';

let folder: string;
let said: string[];
let lan: Lan;
let service: RunningSignaling | null = null;
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), 'farpoint-lan-'));
  said = [];
});
afterEach(async () => {
  await service?.close();
  service = null;
  rmSync(folder, { recursive: true, force: true });
});

async function freePort(): Promise<number> {
  const server = createServer();
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address() as { port: number };
  await new Promise((resolve) => server.close(resolve));
  return port;
}

async function start(given: Partial<SignalingOptions> = {}): Promise<void> {
  const options = {
    ...defaultOptions(),
    ...{
      open: true,
      lan: true,
      lanHosts: ['127.0.0.1', 'localhost'],
      authorityDir: join(folder, 'authority'),
    },
    ...{ port: await freePort(), lanPort: await freePort(), lanInstallPort: await freePort() },
    ...given,
  };
  lan = await openLan(options, {
    ...{ log: silentLogger(), now: Date.now, hostname: 'Laptop', interfaces: {}, random: () => 123_456 },
    say: (text) => said.push(text),
  });
  service = await startSignaling(options, { lan });
}

async function withPairing(): Promise<void> {
  const { secretJwk } = await makeSigningKey();
  const pairKey = join(folder, 'grant-key.json');
  writeFileSync(pairKey, JSON.stringify(secretJwk));
  await start({ pairKey });
}

interface Answer {
  status: number | undefined;
  text: string;
  location: string | undefined;
}

/** By TLS, trusting only what the page for the certificate gives. */
async function ask(path: string, options: RequestOptions = {}, body?: string): Promise<Answer> {
  const ca = await (await fetch(new URL('/farpoint-authority.crt', lan.installAddress))).text();
  return new Promise((resolve, reject) => {
    const call = request(new URL(path, lan.addresses[0]), { ca, ...options }, (response) => {
      let text = '';
      response.setEncoding('utf8');
      response.on('data', (chunk: string) => (text += chunk));
      response.on('end', () =>
        resolve({ status: response.statusCode, text, location: response.headers.location }),
      );
    });
    call.once('error', reject);
    call.end(body);
  });
}

describe('the certificate', () => {
  test('is got from a page without TLS, which shows what the terminal shows; then the service is trusted', async () => {
    await start();
    const page = await (await fetch(lan.installAddress)).text();
    expect(page).toContain(lan.fingerprint);
    expect(page).toContain(lan.addresses[0]);
    const response = await fetch(new URL('/farpoint-authority.crt', lan.installAddress));
    expect(response.headers.get('content-type')).toBe('application/x-x509-ca-cert');
    expect(new X509Certificate(await response.text()).fingerprint256).toBe(lan.fingerprint);
    expect((await ask('/healthz')).status).toBe(200);
  });

  test('is needed: without it, nobody trusts the service', async () => {
    await start();
    const refused = new Promise((resolve) =>
      get(new URL('/healthz', lan.addresses[0])).once('error', resolve),
    );
    expect(await refused).toMatchObject({ code: 'SELF_SIGNED_CERT_IN_CHAIN' });
  });

  test('is of the same authority after a restart', async () => {
    await start();
    const { fingerprint } = lan;
    await service?.close();
    await start();
    expect(lan.fingerprint).toBe(fingerprint);
  });

  test('of an authority that cannot be read: says which file, and replaces nothing', async () => {
    await start();
    writeFileSync(join(folder, 'authority', 'authority.pem'), 'rubbish');
    await expect(start()).rejects.toThrow(/--authority-dir .*there is no certificate in it; remove the file/);
  });

  test('needs an address on a local network', async () => {
    await expect(start({ lanHosts: [] })).rejects.toThrow('needs an address on a local network');
    await expect(start({ lanHosts: ['bank.example'] })).rejects.toThrow(
      '--lan-hosts bank.example is not a name or an address of a local network',
    );
    expect(existsSync(join(folder, 'authority'))).toBe(false);
  });
});

describe('the local network', () => {
  test('gets sessions of its own pages only', async () => {
    await start();
    const ca = await (await fetch(new URL('/farpoint-authority.crt', lan.installAddress))).text();
    const url = new URL('/operator', lan.addresses[0]?.replace('https', 'wss'));
    const opened = (origin: string) =>
      new Promise((resolve) => {
        const socket = new WebSocket(url, { ca, origin });
        socket.once('open', () => resolve('open'));
        socket.once('unexpected-response', (_, { statusCode }) => resolve(statusCode));
      });
    expect(await opened(new URL(lan.addresses[0] ?? '').origin)).toBe('open');
    expect(await opened('https://evil.example')).toBe(403);
    // Beside a service for this machine alone, pages of its other servers would be allowed.
    expect(await opened('http://localhost:5173')).toBe(403);
  });

  test('is not let in without tokens unless that is asked for', async () => {
    await expect(start({ open: false })).rejects.toThrow(OptionsError);
  });
});

describe('pairing', () => {
  const pairing = (back: string) =>
    signInAddress('https://x.local/pair', { key: 'k'.repeat(43), return: back, state: 's' }).replace(
      /^.*pair/,
      '/pair',
    );
  const post = (back: string, code: string) =>
    ask(
      '/pair',
      { method: 'POST', headers: { 'content-type': 'application/x-www-form-urlencoded' } },
      `${new URL(pairing(back), 'https://x.local').searchParams}&code=${code}`,
    );

  test('shows a code in the terminal when a browser waits, and gives a grant for it, once', async () => {
    await withPairing();
    const page = lan.addresses[0] ?? '';
    expect(said).toEqual([]);
    const first = await ask(pairing(page));
    expect(first).toMatchObject({ status: 200 });
    expect(first.text).toContain('name="code"');
    expect(first.text).not.toContain('123456');
    expect(said.join()).toContain('123 456');
    expect(await post(page, '654321')).toMatchObject({
      status: 403,
      text: expect.stringContaining('not the code'),
    });
    const { status, location } = await post(page, '123456');
    expect(status).toBe(303);
    expect(location).toMatch(/^https:\/\/127\.0\.0\.1:\d+\/#grant=[\w.-]+&state=s$/);
    expect(await post(page, '123456')).toMatchObject({
      status: 403,
      text: expect.stringContaining('no longer valid'),
    });
  });

  test('sends nobody elsewhere, and reads no long forms', async () => {
    await withPairing();
    expect((await ask(pairing('https://evil.example/'))).status).toBe(400);
    expect((await post('https://evil.example/', '123456')).status).toBe(400);
    expect((await ask('/pair', { method: 'POST' }, 'x'.repeat(10_000))).status).toBe(413);
    expect((await ask('/pair', { method: 'PUT' })).status).toBe(405);
  });

  test('is where an operator is told to sign in: on this machine without TLS', async () => {
    await withPairing();
    expect(lan.pairingUrl(true)).toBe(`http://localhost:${service?.ports.signaling}/pair`);
    expect(lan.pairingUrl(false)).toBe(`${lan.addresses[0]}pair`);
    const response = await fetch(
      `http://localhost:${service?.ports.signaling}${pairing(lan.addresses[0] ?? '')}`,
    );
    expect(response.status).toBe(200);
  });

  test('is not there without a key, and says what is wrong with one', async () => {
    await start();
    expect(lan.pairingUrl(false)).toBeNull();
    expect((await ask('/pair')).status).toBe(404);
    await service?.close();
    await expect(start({ pairKey: join(folder, 'none.json') })).rejects.toThrow(
      /--pair-key .*none.json does not exist/,
    );
  });
});
