/** Lets a browser in for a pairing code: a grant for its key. Knows HTTP's words, but no socket; time is an argument. */
import { randomBytes } from 'node:crypto';
import { AUDIENCE, grantClaimsSchema, issueGrant, type SigningKey } from '@farpoint/grants';
import { parseSignInRequest, type SignInRequest, signInAnswerHash } from '@farpoint/protocol';
import type { PairingAnswer, PairingCodes } from './pairing-codes.ts';

/** Who is let in may drive, but not block others: that is for people who are known. */
const ROLE = 'drive';
const ISSUER = 'farpoint-signaling';

/** What the pairing page says above its field. */
export type PairingPrompt = 'type' | Exclude<PairingAnswer, 'paired'>;

export type PairingReply =
  | { readonly redirect: string }
  | { readonly request: SignInRequest; readonly prompt: PairingPrompt }
  | { readonly status: 400; readonly text: string };

export interface PairingDeskOptions {
  readonly codes: PairingCodes;
  readonly signingKey: SigningKey;
  /** How long a grant is valid. */
  readonly hours: number;
  /** Whether a page at this address is one of this service. */
  readonly isOwnPage: (address: string) => boolean;
  readonly onPaired: (facts: { readonly subject: string; readonly grant: string }) => void;
}

export class PairingDesk {
  readonly #options: PairingDeskOptions;

  constructor(options: PairingDeskOptions) {
    this.#options = options;
  }

  /** A page of this service sends a browser here. */
  begin(query: URLSearchParams, nowMs: number): PairingReply {
    const read = this.#read(query);
    if ('status' in read) return read;
    return { request: read, prompt: this.#options.codes.ask(nowMs) ? 'type' : 'paused' };
  }

  /** @param form what the pairing page sends: the request, and the code in `code` */
  async finish(form: URLSearchParams, nowMs: number): Promise<PairingReply> {
    const request = this.#read(form);
    if ('status' in request) return request;
    const { codes, hours, signingKey, onPaired } = this.#options;
    const answer = codes.guess(form.get('code') ?? '', nowMs);
    if (answer !== 'paired') {
      // Who types a code too late gets a new one without beginning again.
      if (answer === 'expired') codes.ask(nowMs);
      return { request, prompt: answer };
    }
    const nowS = Math.floor(nowMs / 1000);
    const id = randomBytes(12).toString('base64url');
    const subject = `paired-${id}`;
    const claims = grantClaimsSchema.parse({
      ...{ iss: ISSUER, sub: subject, name: 'Paired browser', aud: AUDIENCE, role: ROLE, robots: ['*'] },
      ...{ cnf: { jkt: request.key }, jti: id, iat: nowS, nbf: nowS, exp: nowS + Math.round(hours * 3600) },
    });
    const grant = await issueGrant(claims, signingKey);
    onPaired({ subject, grant: id });
    const back = new URL(request.return);
    back.hash = signInAnswerHash({ grant, state: request.state });
    return { redirect: back.href };
  }

  #read(query: URLSearchParams): SignInRequest | Extract<PairingReply, { status: 400 }> {
    const read = parseSignInRequest(query);
    if ('request' in read && this.#options.isOwnPage(read.request.return)) return read.request;
    return {
      status: 400,
      text: 'Pairing begins on the operators’ page of this service: open it, choose a robot, and sign in.',
    };
  }
}
