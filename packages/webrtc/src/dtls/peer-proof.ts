/**
 * Checks that a DTLS peer is the signaled one: its certificate has the signaled fingerprint, it holds the certificate's
 * private key, and it has seen the same handshake as we have (RFC 5246 §7.4.3, §7.4.8, §7.4.9; RFC 8122 §6).
 */
import {
  createHash,
  createHmac,
  type KeyObject,
  timingSafeEqual,
  verify,
  X509Certificate,
} from 'node:crypto';

/** Why a peer fails the proof. */
export type Unproven =
  | 'fingerprint-mismatch' // the certificate does not match the description
  | 'bad-certificate' // none, or unreadable
  | 'bad-certificate-verify' // the peer does not hold the certificate's private key
  | 'bad-key-exchange' // the server's key exchange is not signed with its certificate's key
  | 'bad-finished'; // the peer has seen a different handshake, or derived different keys

export class UnprovenPeerError extends Error {
  override readonly name = 'UnprovenPeerError';
  readonly reason: Unproven;

  constructor(reason: Unproven) {
    super(`DTLS: ${reason}`);
    this.reason = reason;
  }
}

export interface Fingerprint {
  algorithm: string;
  value: string;
}

/** Strongest first. MD5 and SHA-1 prove nothing any more (RFC 8122 §5). */
const FINGERPRINT_HASHES: readonly [name: string, algorithm: string][] = [
  ['sha-512', 'sha512'],
  ['sha-384', 'sha384'],
  ['sha-256', 'sha256'],
];
/** Signature schemes that our CertificateRequest and our hello offer, and what Node calls them. */
const SIGNATURE_HASHES: ReadonlyMap<number, { hash: string; key: 'ec' | 'rsa' }> = new Map([
  [0x0403, { hash: 'sha256', key: 'ec' }],
  [0x0401, { hash: 'sha256', key: 'rsa' }],
]);
/** The type of curve (RFC 8422 §5.4). */
const NAMED_CURVE = 3;
/** Of a Finished message (RFC 5246 §7.4.9). */
const VERIFY_DATA_BYTES = 12;
/** Chosen: NIST SP 800-131A disallows shorter keys. */
const MIN_RSA_BITS = 2048;

/**
 * Returns the public key of the peer's certificate, after checking that the certificate is the signaled one. Of the
 * described fingerprints, only those with the strongest algorithm count, and one of them must match.
 *
 * @param body of the Certificate message
 * @throws {UnprovenPeerError}
 */
export function provenCertificateKey(body: Buffer, fingerprints: readonly Fingerprint[]): KeyObject {
  const der = firstCertificate(body);
  if (der === null) throw new UnprovenPeerError('bad-certificate');
  if (!matchesFingerprint(der, fingerprints)) throw new UnprovenPeerError('fingerprint-mismatch');
  try {
    const key = new X509Certificate(der).publicKey;
    if (key.asymmetricKeyType === 'ec') return key;
    const bits = key.asymmetricKeyDetails?.modulusLength ?? 0;
    if (key.asymmetricKeyType === 'rsa' && bits >= MIN_RSA_BITS) return key;
  } catch {
    // Node cannot read it.
  }
  throw new UnprovenPeerError('bad-certificate');
}

/**
 * @param transcript all messages before this one
 * @throws {UnprovenPeerError}
 */
export function checkCertificateVerify(body: Buffer, transcript: Buffer, key: KeyObject): void {
  if (!isSignature(body, 0, transcript, key)) throw new UnprovenPeerError('bad-certificate-verify');
}

/**
 * @param randoms the client's and the server's, 32 bytes each (RFC 8422 §5.4)
 * @throws {UnprovenPeerError}
 */
export function checkServerKeyExchange(body: Buffer, randoms: Buffer, key: KeyObject): void {
  const paramsLength = body.length < 4 ? 0 : 4 + body.readUInt8(3);
  const isNamed = paramsLength > 4 && body.readUInt8(0) === NAMED_CURVE && body.length > paramsLength;
  const signed = Buffer.concat([randoms, body.subarray(0, paramsLength)]);
  if (!isNamed || !isSignature(body, paramsLength, signed, key)) {
    throw new UnprovenPeerError('bad-key-exchange');
  }
}

/**
 * @param transcript all messages before this one
 * @throws {UnprovenPeerError}
 */
export function checkFinished(
  body: Buffer,
  transcript: Buffer,
  masterSecret: Buffer,
  sender: 'client' | 'server',
): void {
  const expected = finishedData(transcript, masterSecret, sender);
  if (body.length !== expected.length || !timingSafeEqual(body, expected)) {
    throw new UnprovenPeerError('bad-finished');
  }
}

/** PRF(master secret, "… finished", hash of the transcript), 12 bytes (RFC 5246 §7.4.9). */
export function finishedData(transcript: Buffer, masterSecret: Buffer, sender: 'client' | 'server'): Buffer {
  const hash = createHash('sha256').update(transcript).digest();
  const seed = Buffer.concat([Buffer.from(`${sender} finished`, 'ascii'), hash]);
  const a1 = createHmac('sha256', masterSecret).update(seed).digest();
  return createHmac('sha256', masterSecret).update(a1).update(seed).digest().subarray(0, VERIFY_DATA_BYTES);
}

function firstCertificate(body: Buffer): Buffer | null {
  if (body.length < 6 || body.readUIntBE(0, 3) !== body.length - 3) return null;
  const length = body.readUIntBE(3, 3);
  return length === 0 || 6 + length > body.length ? null : body.subarray(6, 6 + length);
}

function matchesFingerprint(der: Buffer, fingerprints: readonly Fingerprint[]): boolean {
  for (const [name, algorithm] of FINGERPRINT_HASHES) {
    const described = fingerprints.filter((described) => described.algorithm.trim().toLowerCase() === name);
    if (described.length === 0) continue;
    const actual = createHash(algorithm).update(der).digest('hex');
    return described.some(({ value }) => value.replaceAll(':', '').trim().toLowerCase() === actual);
  }
  return false;
}

/** Verifies a `digitally-signed` struct (RFC 5246 §4.7) at an offset; it must end the body. */
function isSignature(body: Buffer, at: number, signed: Buffer, key: KeyObject): boolean {
  if (body.length < at + 4 || at + 4 + body.readUInt16BE(at + 2) !== body.length) return false;
  const scheme = SIGNATURE_HASHES.get(body.readUInt16BE(at));
  if (scheme === undefined || scheme.key !== key.asymmetricKeyType) return false;
  try {
    return verify(scheme.hash, signed, key, body.subarray(at + 4));
  } catch {
    return false;
  }
}
