import { X509Certificate } from 'node:crypto';
import fc from 'fast-check';
import { beforeAll, describe, expect, test } from 'vitest';
import {
  type Authority,
  AuthorityError,
  issueCertificate,
  makeAuthority,
  readAuthority,
} from './authority.ts';

const NOW = new Date('2026-11-27T12:00:00Z');
const days = (n: number) => new Date(NOW.getTime() + n * 86_400_000);
const HOSTS = ['robot.local', '192.168.1.20', 'fd12::20'];

let authority: Authority;
beforeAll(async () => {
  authority = await makeAuthority({ name: 'Farpoint on laptop', now: NOW });
});

async function faultOf(work: Promise<unknown>): Promise<unknown> {
  const error = await work.then(
    () => null,
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(AuthorityError);
  return (error as AuthorityError).fault;
}

describe('the authority', () => {
  test('is an authority by its name, valid from a day ago for ten years', () => {
    const read = new X509Certificate(authority.certificate);
    expect(read.ca).toBe(true);
    expect(read.subject).toBe('CN=Farpoint on laptop\nO=Farpoint');
    expect(read.verify(read.publicKey)).toBe(true);
    expect(read.validFromDate).toEqual(days(-1));
    expect(read.validToDate).toEqual(days(3650));
  });

  test('is another one each time', async () => {
    const other = await makeAuthority({ name: 'Farpoint on laptop', now: NOW });
    expect(new X509Certificate(other.certificate).fingerprint256).not.toBe(
      new X509Certificate(authority.certificate).fingerprint256,
    );
  });
});

describe('a certificate', () => {
  test('is issued by the authority, for these hosts and for servers only', async () => {
    const issued = await issueCertificate(authority, { hosts: HOSTS, now: NOW });
    const leaf = new X509Certificate(issued.certificate);
    const issuer = new X509Certificate(authority.certificate);
    expect(leaf.checkIssued(issuer)).toBe(true);
    expect(leaf.verify(issuer.publicKey)).toBe(true);
    expect(leaf.ca).toBe(false);
    expect(leaf.checkHost('robot.local')).toBe('robot.local');
    expect(leaf.checkIP('192.168.1.20')).toBe('192.168.1.20');
    expect(leaf.checkIP('fd12::20')).toBe('fd12::20');
    expect(leaf.checkHost('other.local')).toBeUndefined();
    expect(leaf.checkIP('192.168.1.21')).toBeUndefined();
    expect(leaf.keyUsage).toEqual(['1.3.6.1.5.5.7.3.1']);
    expect(leaf.validToDate).toEqual(days(397));
    // The whole chain, as servers send it.
    expect(issued.certificate.match(/BEGIN CERTIFICATE/g)).toHaveLength(2);
    expect(issued.certificate.endsWith(authority.certificate)).toBe(true);
  });

  test('ends with its authority', async () => {
    const now = days(3600);
    const leaf = new X509Certificate((await issueCertificate(authority, { hosts: HOSTS, now })).certificate);
    expect(leaf.validToDate).toEqual(days(3650));
  });

  test.each(['example.com', '8.8.8.8', '2001:db8::1', 'Robot.local', '*.local', ''])(
    'is not issued for “%s”',
    async (host) => {
      const issuing = issueCertificate(authority, { hosts: ['robot.local', host], now: NOW });
      expect(await faultOf(issuing)).toEqual({ kind: 'not-local', host });
    },
  );

  test('is not issued for nothing', async () => {
    expect(await faultOf(issueCertificate(authority, { hosts: [], now: NOW }))).toEqual({ kind: 'no-hosts' });
  });

  test('is not issued by an authority that has expired', async () => {
    expect(await faultOf(issueCertificate(authority, { hosts: HOSTS, now: days(3650) }))).toEqual({
      kind: 'expired',
      since: days(3650),
    });
  });
});

describe('an authority that is read', () => {
  test('with the key of another one is refused', async () => {
    const { key } = await makeAuthority({ name: 'Other', now: NOW });
    expect(await faultOf(readAuthority({ ...authority, key }, NOW))).toEqual({ kind: 'mismatch' });
  });

  test('of any other text is refused, and says why', async () => {
    await fc.assert(
      fc.asyncProperty(fc.string(), fc.boolean(), async (text, isKey) => {
        const read = readAuthority(
          isKey ? { ...authority, key: text } : { ...authority, certificate: text },
          NOW,
        );
        expect(await faultOf(read)).toMatchObject({ kind: 'unreadable' });
      }),
    );
  });
});
