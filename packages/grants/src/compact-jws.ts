/** Reads the compact form of a JWS (RFC 7515 §7.1): header and payload as JSON, both checked. */
import { base64url, type CryptoKey } from 'jose';
import * as z from 'zod/mini';

const FORM = /^[A-Za-z0-9_-]+\.[A-Za-z0-9_-]+\.[A-Za-z0-9_-]*$/;
const utf8 = new TextDecoder('utf-8', { fatal: true });

/** How the faults of one kind of JWS are named. */
export interface JwsKind {
  /** What it is, for error texts. */
  what: string;
  maxLength: number;
  malformed: (detail: string) => Error;
  /** The signature does not match. */
  forged: (detail: string) => Error;
}

/**
 * The protected header, before anything is verified.
 *
 * @throws {Error} the kind's
 */
export function readHeader<T>(kind: JwsKind, schema: z.core.$ZodType<T>, text: string): T {
  if (text.length > kind.maxLength) throw refused(kind, `longer than ${kind.maxLength} characters`);
  if (!FORM.test(text)) throw refused(kind, 'not the compact form of a JWS');
  return parsePart(kind, 'header', schema, text.slice(0, text.indexOf('.')));
}

/**
 * The payload, without a look at the signature: to show what is in it, never to act upon it.
 *
 * @throws {Error} the kind's
 */
export function readPayload<T>(kind: JwsKind, schema: z.core.$ZodType<T>, text: string): T {
  return parsePart(kind, 'payload', schema, text.slice(text.indexOf('.') + 1, text.lastIndexOf('.')));
}

/**
 * Verifies the signature.
 *
 * @param alg the only algorithm that counts; the header's word is not taken for it
 * @throws {Error} the kind's
 */
export async function checkSignature(
  kind: JwsKind,
  text: string,
  key: CryptoKey,
  alg: string,
): Promise<void> {
  const { compactVerify, errors } = await import('./signatures.ts');
  try {
    await compactVerify(text, key, { algorithms: [alg] });
  } catch (error) {
    if (error instanceof errors.JWSSignatureVerificationFailed || error instanceof errors.JOSEAlgNotAllowed)
      throw kind.forged('the signature does not match');
    if (error instanceof errors.JOSEError) throw refused(kind, error.message);
    throw error;
  }
}

function parsePart<T>(kind: JwsKind, part: string, schema: z.core.$ZodType<T>, text: string): T {
  let value: unknown;
  try {
    value = JSON.parse(utf8.decode(base64url.decode(text)));
  } catch {
    throw refused(kind, `its ${part} is not JSON in base64url`);
  }
  const parsed = z.safeParse(schema, value);
  if (parsed.success) return parsed.data;
  const path = parsed.error.issues[0]?.path.map(String).join('.') ?? '';
  throw refused(kind, `its ${part} has an invalid value${path === '' ? '' : ` at ${path}`}`);
}

function refused({ what, malformed }: JwsKind, detail: string): Error {
  return malformed(`${what}: ${detail}`);
}
