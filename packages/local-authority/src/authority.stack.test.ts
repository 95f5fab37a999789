/** Whether others believe its certificates, and only for local networks: a real TLS handshake by OpenSSL. */
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { connect, createServer } from 'node:tls';
import * as x509 from '@peculiar/x509';
import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import { type Authority, type IssuedCertificate, issueCertificate, makeAuthority } from './authority.ts';
import { openAuthority } from './authority-folder.ts';

const NOW = new Date();
const ALGORITHM = { name: 'ECDSA', namedCurve: 'P-256', hash: 'SHA-256' };

/** @returns how a client that trusts the authority judges the server */
async function judged(authority: Authority, server: IssuedCertificate, servername: string): Promise<string> {
  const listening = createServer({ cert: server.certificate, key: server.key });
  await new Promise<void>((resolve) => listening.listen(0, '127.0.0.1', resolve));
  try {
    const { port } = listening.address() as { port: number };
    const socket = connect({
      host: '127.0.0.1',
      port,
      servername,
      ca: authority.certificate,
      rejectUnauthorized: false,
    });
    await new Promise((resolve, reject) => socket.once('secureConnect', resolve).once('error', reject));
    const verdict = socket.authorized ? 'trusted' : String(socket.authorizationError);
    socket.destroy();
    return verdict;
  } finally {
    listening.close();
  }
}

/** What a thief of the authority's key could make: a certificate for any host. */
async function forged(authority: Authority, host: string): Promise<IssuedCertificate> {
  const issuer = new x509.X509Certificate(authority.certificate);
  const [der] = x509.PemConverter.decode(authority.key);
  const signingKey = await crypto.subtle.importKey('pkcs8', der as ArrayBuffer, ALGORITHM, true, ['sign']);
  const keys = await crypto.subtle.generateKey(ALGORITHM, true, ['sign', 'verify']);
  const made = await x509.X509CertificateGenerator.create({
    ...{ subject: [{ CN: [host] }], issuer: issuer.subject, signingAlgorithm: ALGORITHM },
    ...{ publicKey: keys.publicKey, signingKey },
    extensions: [new x509.SubjectAlternativeNameExtension([{ type: 'dns', value: host }])],
  });
  const key = await crypto.subtle.exportKey('pkcs8', keys.privateKey);
  return {
    certificate: `${made.toString('pem')}\n${authority.certificate}`,
    key: x509.PemConverter.encode(key, 'PRIVATE KEY'),
  };
}

describe('a client that trusts the authority', () => {
  test('trusts a server at a local name or address', async () => {
    const authority = await makeAuthority({ name: 'Test', now: NOW });
    const server = await issueCertificate(authority, { hosts: ['robot.local', '192.168.1.20'], now: NOW });
    expect(await judged(authority, server, 'robot.local')).toBe('trusted');
    expect(await judged(authority, server, 'other.local')).toBe('ERR_TLS_CERT_ALTNAME_INVALID');
  });

  test('does not trust the authority’s own key with a site of the internet', async () => {
    const authority = await makeAuthority({ name: 'Test', now: NOW });
    expect(await judged(authority, await forged(authority, 'robot.local'), 'robot.local')).toBe('trusted');
    expect(await judged(authority, await forged(authority, 'bank.example'), 'bank.example')).toBe(
      // OpenSSL’s “permitted subtree violation” has no name in Node.
      'UNSPECIFIED',
    );
  });

  test('does not trust another authority of the same name', async () => {
    const [ours, theirs] = await Promise.all([1, 2].map(() => makeAuthority({ name: 'Test', now: NOW })));
    const server = await issueCertificate(theirs as Authority, { hosts: ['robot.local'], now: NOW });
    expect(await judged(ours as Authority, server, 'robot.local')).not.toBe('trusted');
  });
});

describe('the folder', () => {
  let folder: string;
  beforeEach(() => {
    folder = join(mkdtempSync(join(tmpdir(), 'farpoint-authority-')), 'authority');
  });
  afterEach(() => rmSync(folder, { recursive: true, force: true }));
  const open = () => openAuthority(folder, { name: 'Test', now: NOW });
  const file = () => join(folder, 'authority.pem');

  test('keeps the authority, for its user alone', async () => {
    const made = await open();
    expect(await open()).toEqual(made);
    expect(statSync(file()).mode & 0o777).toBe(0o600);
    expect(statSync(folder).mode & 0o777).toBe(0o700);
  });

  test('has one authority, however many programs start at once', async () => {
    const opened = await Promise.all([open(), open(), open()]);
    expect(new Set(opened.map(({ certificate }) => certificate)).size).toBe(1);
  });

  test('with something else in the file: says what is missing, and leaves it there', async () => {
    const { certificate } = await open();
    writeFileSync(file(), certificate);
    await expect(open()).rejects.toThrow('there is no private key in it');
    writeFileSync(file(), 'rubbish');
    await expect(open()).rejects.toThrow('there is no certificate in it');
    expect(readFileSync(file(), 'utf8')).toBe('rubbish');
  });
});
