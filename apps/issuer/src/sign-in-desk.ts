/** A sign-in from its request to its grant. Knows HTTP's words, but no socket; time is an argument. */
import { randomBytes } from 'node:crypto';
import { issueGrant, type SigningKey } from '@farpoint/grants';
import {
  parseSignInRequest,
  type SignInError,
  type SignInRequest,
  signInAnswerHash,
} from '@farpoint/protocol';
import { AddressLimiter } from './address-limiter.ts';
import type { Consent } from './consent-page.ts';
import { type GrantTerms, grantFor } from './grant-for.ts';
import { PendingSignIns } from './pending-sign-ins.ts';
import { type Person, personOf } from './person.ts';
import type { Provider } from './provider.ts';
import { SignInRefusedError } from './provider-fault.ts';
import { type Rule, ruleFor } from './rules.ts';

/** By its exact address, but for the query, in which the page keeps what it shows. */
export function isAllowedPage(pages: readonly string[], address: string): boolean {
  const { origin, pathname } = new URL(address);
  return pages.some((each) => {
    const page = new URL(each);
    return page.origin === origin && page.pathname === pathname;
  });
}

/** All sign-ins that have begun, of all addresses. */
const MOST_PENDING = 4096;

/** Where a browser is sent, or what it is shown. */
export type Reply =
  | { readonly redirect: string; readonly browser?: string }
  /** A question, whose answer comes to `answer`. */
  | { readonly consent: Consent; readonly browser: string }
  | { readonly status: 400 | 429; readonly text: string };

/** How a sign-in ended, or why it did not begin. */
export type Outcome = 'granted' | SignInError | 'bad-return' | 'unknown' | 'other-browser';

export interface DeskOptions {
  readonly provider: Pick<Provider, 'begin' | 'finish'>;
  readonly signingKey: SigningKey;
  readonly terms: GrantTerms;
  readonly rules: readonly Rule[];
  readonly pages: readonly string[];
  readonly signInsPerMinute: number;
  /** @param facts for the log */
  readonly onOutcome: (outcome: Outcome, facts: Readonly<Record<string, string>>) => void;
}

/** Who asks. */
export interface Caller {
  readonly address: string;
  /** The browser's secret; `null` if it has none. */
  readonly browser: string | null;
}

/** A grant that its person has not agreed to yet. */
interface Offered {
  readonly request: SignInRequest;
  readonly person: Person;
  readonly rule: Rule;
}

export class SignInDesk {
  readonly #options: DeskOptions;
  readonly #pending = new PendingSignIns(MOST_PENDING);
  readonly #offered = new PendingSignIns<Offered>(MOST_PENDING);
  readonly #beginnings: AddressLimiter;
  readonly #ends: AddressLimiter;
  readonly #answers: AddressLimiter;

  constructor(options: DeskOptions) {
    this.#options = options;
    this.#beginnings = new AddressLimiter(options.signInsPerMinute);
    this.#ends = new AddressLimiter(options.signInsPerMinute);
    this.#answers = new AddressLimiter(options.signInsPerMinute);
  }

  /** Sign-ins that have begun and not ended. */
  get pending(): number {
    return this.#pending.size + this.#offered.size;
  }

  /** A page sends a browser here. */
  async begin(query: URLSearchParams, { address, browser }: Caller, nowMs: number): Promise<Reply> {
    const { pages, provider } = this.#options;
    const read = parseSignInRequest(query);
    const back = 'request' in read ? read.request.return : read.return;
    if (back === null || !isAllowedPage(pages, back)) {
      this.#tell('bad-return', { address });
      return {
        status: 400,
        text: 'This page may not ask for a sign-in here. Its address must be one of --pages.',
      };
    }
    if ('fault' in read)
      return this.#refuse({ return: back, state: null }, 'bad-request', { address, detail: read.fault });
    const { request } = read;
    if (!this.#beginnings.take(address, nowMs)) return this.#refuse(request, 'too-many', { address });
    const [state, nonce, verifier] = [secret(), secret(), secret()];
    const pending = { request, nonce, verifier };
    try {
      const redirect = await provider.begin(state, pending, nowMs);
      const owner = browser ?? secret();
      this.#pending.add(state, owner, pending, nowMs);
      return { redirect, browser: owner };
    } catch (error) {
      return this.#failed(request, error, address);
    }
  }

  /** The provider sends the browser here. */
  async finish(query: URLSearchParams, { address, browser }: Caller, nowMs: number): Promise<Reply> {
    if (!this.#ends.take(address, nowMs)) {
      this.#tell('too-many', { address });
      return { status: 429, text: 'Too many requests from this address. Wait a minute, then sign in again.' };
    }
    const state = query.get('state') ?? '';
    const taken = this.#pending.take(state, browser, nowMs);
    if (!('pending' in taken)) {
      this.#tell(taken.outcome, { address });
      return {
        status: 400,
        text: 'This sign-in was not begun in this browser, or is over. Go back to the page, and sign in again.',
      };
    }
    const { request } = taken.pending;
    if (taken.outcome === 'expired') return this.#refuse(request, 'expired', { address });
    try {
      const signedIn = await this.#options.provider.finish(query, state, taken.pending, nowMs);
      // It was found by the browser's secret.
      return this.#ask(request, signedIn, browser ?? '', nowMs);
    } catch (error) {
      return this.#failed(request, error, address);
    }
  }

  /** The person answers whether the page may have the grant. */
  async answer(form: URLSearchParams, { address, browser }: Caller, nowMs: number): Promise<Reply> {
    if (!this.#answers.take(address, nowMs)) {
      this.#tell('too-many', { address });
      return { status: 429, text: 'Too many requests from this address. Wait a minute, then sign in again.' };
    }
    const taken = this.#offered.take(form.get('token') ?? '', browser, nowMs);
    if (!('pending' in taken)) {
      this.#tell(taken.outcome, { address });
      return {
        status: 400,
        text: 'Nobody asks this here any more. Go back to the page, and sign in again.',
      };
    }
    const { request, person } = taken.pending;
    const who = { subject: person.subject, person: person.name };
    if (taken.outcome === 'expired') return this.#refuse(request, 'expired', who);
    if (form.get('answer') !== 'yes') return this.#refuse(request, 'cancelled', who);
    try {
      return await this.#grant(taken.pending, nowMs);
    } catch (error) {
      return this.#failed(request, error, address);
    }
  }

  /**
   * Any link can begin a sign-in, for whatever key it names, and a provider that knows the browser asks for no password: so
   * nothing is signed before the person has seen for which page, and agreed.
   */
  #ask(
    request: SignInRequest,
    { issuer, sub, claims }: Awaited<ReturnType<Provider['finish']>>,
    browser: string,
    nowMs: number,
  ): Reply {
    const { rules, terms } = this.#options;
    const person = personOf(issuer, sub, claims);
    const rule = ruleFor(rules, claims);
    if (rule === null)
      return this.#refuse(request, 'not-permitted', { subject: person.subject, person: person.name });
    const token = secret();
    this.#offered.add(token, browser, { request, person, rule }, nowMs);
    const { role, robots } = rule;
    const asked = { page: request.return, person: person.name, key: request.key, hours: terms.hours };
    return { consent: { token, ...asked, role, robots }, browser };
  }

  async #grant({ request, person, rule }: Offered, nowMs: number): Promise<Reply> {
    const { terms, signingKey } = this.#options;
    const id = randomBytes(12).toString('base64url');
    const granted = grantFor(person, rule, terms, { key: request.key, id, nowS: nowMs / 1000 });
    const grant = await issueGrant(granted, signingKey);
    const { sub: subject, name, role, robots } = granted;
    this.#tell('granted', { subject, person: name, role, robots: robots.join(','), grant: id });
    return { redirect: addressOf(request, { grant, state: request.state }) };
  }

  #failed(request: SignInRequest, error: unknown, address: string): Reply {
    const reason = error instanceof SignInRefusedError ? error.reason : 'issuer-failed';
    const detail = error instanceof Error ? error.message : String(error);
    return this.#refuse(request, reason, { address, detail });
  }

  #refuse(
    request: Pick<SignInRequest, 'return' | 'state'>,
    error: SignInError,
    facts: Readonly<Record<string, string>>,
  ): Reply {
    this.#tell(error, facts);
    return { redirect: addressOf(request, { error, state: request.state }) };
  }

  #tell(outcome: Outcome, facts: Readonly<Record<string, string>>): void {
    this.#options.onOutcome(outcome, facts);
  }
}

function addressOf(
  { return: back }: Pick<SignInRequest, 'return'>,
  answer: Parameters<typeof signInAnswerHash>[0],
): string {
  const url = new URL(back);
  url.hash = signInAnswerHash(answer);
  return url.href;
}

/** 256 random bits. */
function secret(): string {
  return randomBytes(32).toString('base64url');
}
