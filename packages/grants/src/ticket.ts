/** A grant together with the key that it names, for people whose page has no key of its own. Secret. */
import { base64url } from 'jose';
import * as z from 'zod/mini';
import { MAX_GRANT_LENGTH } from './grant-claims.ts';
import { type OperatorSecretJwk, operatorSecretJwkSchema } from './operator-key.ts';

const PREFIX = 'farpoint-ticket.';
/** Characters. Chosen: above the longest grant with its key in base64url. */
const MAX_TICKET_LENGTH = 8192;

export interface Ticket {
  grant: string;
  key: OperatorSecretJwk;
}

const ticketSchema = z.strictObject({
  grant: z.string().check(z.minLength(1), z.maxLength(MAX_GRANT_LENGTH)),
  key: operatorSecretJwkSchema,
});

/** @returns one line of printable characters without spaces */
export function encodeTicket(ticket: Ticket): string {
  return PREFIX + base64url.encode(new TextEncoder().encode(JSON.stringify(ticket)));
}

/** @returns `null` if it is not a ticket; the grant in it is not checked */
export function decodeTicket(text: string): Ticket | null {
  if (text.length > MAX_TICKET_LENGTH || !text.startsWith(PREFIX)) return null;
  try {
    const value: unknown = JSON.parse(new TextDecoder().decode(base64url.decode(text.slice(PREFIX.length))));
    return z.safeParse(ticketSchema, value).data ?? null;
  } catch {
    return null;
  }
}
