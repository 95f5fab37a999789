/** A certificate authority whose certificates hold on local networks only (X.509, RFC 5280). */
import type { webcrypto } from 'node:crypto';
import { isIP } from 'node:net';
import { AsnConvert } from '@peculiar/asn1-schema';
import {
  GeneralName,
  GeneralSubtree,
  GeneralSubtrees,
  id_ce_nameConstraints,
  NameConstraints,
} from '@peculiar/asn1-x509';
import * as x509 from '@peculiar/x509';
import { isLocalHost } from './local-addresses.ts';
import { LOCAL_DOMAINS, LOCAL_NETWORKS } from './local-names.ts';

/** Both as PEM. The key can sign for every local host: it stays on this machine. */
export interface Authority {
  readonly certificate: string;
  readonly key: string;
}

/** Both as PEM, for a TLS server. */
export interface IssuedCertificate {
  readonly certificate: string;
  readonly key: string;
}

export type AuthorityFault =
  | { readonly kind: 'not-local'; readonly host: string }
  | { readonly kind: 'no-hosts' }
  | { readonly kind: 'unreadable'; readonly detail: string }
  | { readonly kind: 'mismatch' }
  | { readonly kind: 'expired'; readonly since: Date };

export class AuthorityError extends Error {
  readonly fault: AuthorityFault;

  constructor(fault: AuthorityFault) {
    super(describe(fault));
    this.name = 'AuthorityError';
    this.fault = fault;
  }
}

function describe(fault: AuthorityFault): string {
  switch (fault.kind) {
    case 'not-local':
      return `${fault.host} is not a name or an address of a local network`;
    case 'no-hosts':
      return 'there is no name or address to issue a certificate for';
    case 'unreadable':
      return `is not a certificate with its key in PEM: ${fault.detail}`;
    case 'mismatch':
      return 'the key is not that of the certificate';
    case 'expired':
      return `the certificate is valid no longer, since ${fault.since.toISOString()}`;
  }
}

const DAY_MS = 86_400_000;
/** Each headset must be given the authority by hand, so it lasts. */
const AUTHORITY_DAYS = 3650;
/** Apple's platforms accept no more from an authority that was installed by hand; issued anew at each start anyway. */
const CERTIFICATE_DAYS = 397;
/** Headsets that were switched off for long have clocks that are behind. */
const EARLIER_MS = DAY_MS;

const ALGORITHM = { name: 'ECDSA', namedCurve: 'P-256', hash: 'SHA-256' };

/**
 * Makes an authority with a key of its own.
 *
 * @param name what people read in a headset's list of authorities
 */
export async function makeAuthority({ name, now }: { name: string; now: Date }): Promise<Authority> {
  const keys = await crypto.subtle.generateKey(ALGORITHM, true, ['sign', 'verify']);
  const certificate = await x509.X509CertificateGenerator.createSelfSigned(
    {
      name: [{ CN: [name] }, { O: ['Farpoint'] }],
      notBefore: new Date(now.getTime() - EARLIER_MS),
      notAfter: new Date(now.getTime() + AUTHORITY_DAYS * DAY_MS),
      signingAlgorithm: ALGORITHM,
      keys,
      extensions: [
        new x509.BasicConstraintsExtension(true, 0, true),
        new x509.KeyUsagesExtension(x509.KeyUsageFlags.keyCertSign | x509.KeyUsageFlags.cRLSign, true),
        await x509.SubjectKeyIdentifierExtension.create(keys.publicKey),
        localOnly(),
      ],
    },
    crypto,
  );
  return { certificate: pem(certificate), key: await keyPem(keys.privateKey) };
}

/**
 * Issues a certificate, with a key of its own, for a server at these names and addresses.
 *
 * @param hosts DNS names in lower case, IPv4 and IPv6 addresses; all of a local network
 * @throws {AuthorityError} for another host, or an authority that is unreadable or expired
 */
export async function issueCertificate(
  authority: Authority,
  { hosts, now }: { hosts: readonly string[]; now: Date },
): Promise<IssuedCertificate> {
  if (hosts.length === 0) throw new AuthorityError({ kind: 'no-hosts' });
  for (const host of hosts) {
    if (!isLocalHost(host)) throw new AuthorityError({ kind: 'not-local', host });
  }
  const { certificate: issuer, key } = await readAuthority(authority, now);
  const keys = await crypto.subtle.generateKey(ALGORITHM, true, ['sign', 'verify']);
  const notAfter = Math.min(now.getTime() + CERTIFICATE_DAYS * DAY_MS, issuer.notAfter.getTime());
  const certificate = await x509.X509CertificateGenerator.create(
    {
      subject: [{ CN: [hosts[0] as string] }],
      issuer: issuer.subject,
      notBefore: new Date(now.getTime() - EARLIER_MS),
      notAfter: new Date(notAfter),
      signingAlgorithm: ALGORITHM,
      publicKey: keys.publicKey,
      signingKey: key,
      extensions: [
        new x509.BasicConstraintsExtension(false, undefined, true),
        new x509.KeyUsagesExtension(x509.KeyUsageFlags.digitalSignature, true),
        new x509.ExtendedKeyUsageExtension([x509.ExtendedKeyUsage.serverAuth]),
        new x509.SubjectAlternativeNameExtension(
          hosts.map((value) => ({ type: isIP(value) === 0 ? 'dns' : 'ip', value })),
        ),
        await x509.AuthorityKeyIdentifierExtension.create(issuer.publicKey),
        await x509.SubjectKeyIdentifierExtension.create(keys.publicKey),
      ],
    },
    crypto,
  );
  return { certificate: `${pem(certificate)}${authority.certificate}`, key: await keyPem(keys.privateKey) };
}

/** @throws {AuthorityError} if it is not an authority's certificate that is valid now, with its key */
export async function readAuthority(
  { certificate, key }: Authority,
  now: Date,
): Promise<{ certificate: x509.X509Certificate; key: webcrypto.CryptoKey }> {
  let read: { certificate: x509.X509Certificate; key: webcrypto.CryptoKey };
  try {
    const [der] = x509.PemConverter.decode(key);
    if (der === undefined) throw new Error('there is no key');
    read = {
      certificate: new x509.X509Certificate(certificate),
      key: await crypto.subtle.importKey('pkcs8', der, ALGORITHM, true, ['sign']),
    };
  } catch (error) {
    throw new AuthorityError({
      kind: 'unreadable',
      detail: error instanceof Error ? error.message : String(error),
    });
  }
  if (read.certificate.notAfter <= now)
    throw new AuthorityError({ kind: 'expired', since: read.certificate.notAfter });
  if (!(await belongs(read))) throw new AuthorityError({ kind: 'mismatch' });
  return read;
}

/** Whether what the key signs is what the certificate's public key verifies. */
async function belongs({
  certificate,
  key,
}: {
  certificate: x509.X509Certificate;
  key: webcrypto.CryptoKey;
}): Promise<boolean> {
  const text = new TextEncoder().encode('farpoint');
  const publicKey = await certificate.publicKey.export(ALGORITHM, ['verify'], crypto);
  return crypto.subtle.verify(ALGORITHM, publicKey, await crypto.subtle.sign(ALGORITHM, key, text), text);
}

function localOnly(): x509.Extension {
  const names = [
    ...LOCAL_DOMAINS.map((dNSName) => new GeneralName({ dNSName })),
    ...LOCAL_NETWORKS.map((iPAddress) => new GeneralName({ iPAddress })),
  ];
  const permittedSubtrees = new GeneralSubtrees(names.map((base) => new GeneralSubtree({ base })));
  return new x509.Extension(
    id_ce_nameConstraints,
    true,
    AsnConvert.serialize(new NameConstraints({ permittedSubtrees })),
  );
}

function pem(certificate: x509.X509Certificate): string {
  return `${certificate.toString('pem').trim()}\n`;
}

async function keyPem(key: webcrypto.CryptoKey): Promise<string> {
  const der = await crypto.subtle.exportKey('pkcs8', key);
  return `${x509.PemConverter.encode(der, 'PRIVATE KEY').trim()}\n`;
}
