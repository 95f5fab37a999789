/** Entries of the log: one line of canonical JSON each, which carries its own hash and that of the entry before. */
import { createHash } from 'node:crypto';
import * as z from 'zod';
import type { AuditEvent } from './audit-event.ts';
import { canonicalJson, type JsonValue } from './canonical-json.ts';

/** What the first entry has in place of the hash before it. */
export const NO_PREVIOUS = '0'.repeat(64);
/** Maximum length of a line, bytes. */
export const MAX_LINE_BYTES = 65_536;
/** Names come from outside. */
const MAX_NAME = 200;

const hashSchema = z.string().regex(/^[0-9a-f]{64}$/);

const entrySchema = z.strictObject({
  version: z.literal(1),
  sequence: z.int().min(0),
  time: z.string().regex(/^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$/),
  kind: z.string().regex(/^[a-z][a-z-]{0,39}$/),
  subject: z.optional(
    z.strictObject({
      id: z.optional(z.string()),
      name: z.string(),
      role: z.optional(z.string()),
      grant: z.optional(z.string()),
      proven: z.boolean(),
    }),
  ),
  session: z.optional(z.string()),
  robot: z.optional(z.string()),
  details: z.optional(z.record(z.string(), z.unknown())),
  previous: hashSchema,
  hash: hashSchema,
});

export type AuditEntry = z.output<typeof entrySchema>;

/** The end of a chain, to which the next entry is added. */
export interface ChainEnd {
  /** Number of the next entry; the first is 0. */
  readonly sequence: number;
  /** Hash of the last entry. */
  readonly previous: string;
}

export const CHAIN_START: ChainEnd = { sequence: 0, previous: NO_PREVIOUS };

/**
 * Writes an event as the next entry of a chain.
 *
 * @param timeMs when it happened, ms since 1970
 * @returns the line with its newline, and the chain's new end
 */
export function makeEntry(
  { sequence, previous }: ChainEnd,
  event: AuditEvent,
  timeMs: number,
): { line: string; end: ChainEnd } {
  const { kind, subject, session, robot, details } = event;
  const body = {
    version: 1,
    sequence,
    time: new Date(timeMs).toISOString(),
    kind,
    session,
    robot,
    details,
    subject: subject === undefined ? undefined : { ...subject, name: subject.name.slice(0, MAX_NAME) },
    previous,
  };
  const made = seal(body);
  if (Buffer.byteLength(made.line) <= MAX_LINE_BYTES)
    return { line: made.line, end: { sequence: sequence + 1, previous: made.hash } };
  const text = canonicalJson(details ?? {});
  const cut = seal({
    ...body,
    details: { tooLong: Buffer.byteLength(text), sha256: sha256(text) },
  });
  return { line: cut.line, end: { sequence: sequence + 1, previous: cut.hash } };
}

/**
 * Reads a line without its newline.
 *
 * @returns null unless every byte of it is as it was written
 */
export function readEntry(line: Uint8Array): AuditEntry | null {
  if (line.byteLength >= MAX_LINE_BYTES) return null;
  let text: string;
  let value: unknown;
  try {
    text = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(line);
    value = JSON.parse(text);
  } catch {
    return null;
  }
  const parsed = entrySchema.safeParse(value);
  if (!parsed.success) return null;
  const { hash: _, ...body } = value as { readonly [key: string]: JsonValue };
  // The line contains the hash, so comparing the line compares the hash as well.
  return seal(body).line === `${text}\n` ? parsed.data : null;
}

export function sha256(bytes: string | Uint8Array): string {
  return createHash('sha256').update(bytes).digest('hex');
}

function seal(body: { readonly [key: string]: JsonValue | undefined }): { line: string; hash: string } {
  const hash = sha256(canonicalJson(body));
  return { line: `${canonicalJson({ ...body, hash })}\n`, hash };
}

/**
 * Names a secret without telling it: the first 12 hexadecimal digits of the SHA-256 of purpose and text. The same
 * session has the same name in every log. A secret that can be guessed can also be recognised.
 */
export function shortHash(purpose: 'session' | 'token', text: string): string {
  return createHash('sha256').update(`farpoint ${purpose}\n${text}`).digest('hex').slice(0, 12);
}
