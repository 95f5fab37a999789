/**
 * Sign-in: the page sends the browser to an issuer of grants, which sends it back with a grant. Both directions are
 * addresses, because a redirect can carry nothing else.
 */
import * as z from 'zod/mini';
import { handleSchema } from './identifiers.ts';

/** Characters. */
export const MAX_SIGN_IN_URL = 512;
/** Characters of the page's address, to which the issuer sends the browser back. */
export const MAX_RETURN_URL = 2048;

/** Whether nobody on the way can read or change what is sent there: https, or http on this machine. */
export function isProtectedUrl(text: string): boolean {
  if (!URL.canParse(text)) return false;
  const url = new URL(text);
  if (url.username !== '' || url.password !== '') return false;
  return url.protocol === 'https:' || (url.protocol === 'http:' && isLoopbackHost(url.hostname));
}

/** Where operators sign in, as the signaling service tells them. */
export const signInUrlSchema = z.string().check(
  z.maxLength(MAX_SIGN_IN_URL),
  z.refine(
    (text) => isProtectedUrl(text) && !/[?#]/.test(text),
    'must be an https address without a query (http on loopback only)',
  ),
);

const thumbprintSchema = z.string().check(z.regex(/^[A-Za-z0-9_-]{43}$/));
const returnSchema = z.string().check(z.maxLength(MAX_RETURN_URL), z.refine(isProtectedUrl));

/** What the page asks for, in the query of the sign-in address. */
export interface SignInRequest {
  /** The thumbprint of the operator's own key (RFC 7638), for which the grant is made. */
  key: string;
  /** The address of the page, without a fragment. */
  return: string;
  /** Made by the page and repeated in the answer, so that the page recognises the answer. */
  state: string | null;
}

/** What is wrong with a request. If it is the return address, there is nowhere to say so. */
export type SignInRequestFault = 'bad-return' | 'bad-key' | 'bad-state';

/** The address that the browser goes to. */
export function signInAddress(signInUrl: string, { key, return: back, state }: SignInRequest): string {
  const query = new URLSearchParams({ key, return: back, ...(state === null ? {} : { state }) });
  return `${signInUrl}?${query}`;
}

/** Reads what {@link signInAddress} writes. @returns with `return` whenever the browser may be sent back */
export function parseSignInRequest(
  query: URLSearchParams,
): { request: SignInRequest } | { fault: SignInRequestFault; return: string | null } {
  const [key, back, state] = [query.get('key'), query.get('return'), query.get('state')];
  if (!returnSchema.safeParse(back).success || back === null || back.includes('#'))
    return { fault: 'bad-return', return: null };
  if (state !== null && !handleSchema.safeParse(state).success) return { fault: 'bad-state', return: back };
  if (key === null || !thumbprintSchema.safeParse(key).success) return { fault: 'bad-key', return: back };
  return { request: { key, return: back, state } };
}

/** Why nobody was signed in. */
export const signInErrors = [
  'not-permitted', // signed in, but no rule of the issuer gives this person a grant
  'cancelled', // by the person, at the provider
  'expired', // took longer than ten minutes
  'provider-unreachable',
  'provider-refused', // the provider refused the issuer or its request
  'unproven', // what the provider sent does not prove who signed in
  'bad-request', // from the page
  'too-many', // sign-ins from this address
  'issuer-failed',
] as const;
export type SignInError = (typeof signInErrors)[number];

/** What the issuer answers, in the fragment of the page's address: a fragment is not sent to any server. */
export type SignInAnswer = ({ grant: string } | { error: SignInError }) & { state: string | null };

/** @returns the fragment, with `#` */
export function signInAnswerHash(answer: SignInAnswer): string {
  const { state } = answer;
  const content = 'grant' in answer ? { grant: answer.grant } : { 'sign-in-error': answer.error };
  return `#${new URLSearchParams({ ...content, ...(state === null ? {} : { state }) })}`;
}

/**
 * Reads what {@link signInAnswerHash} writes. The text of a grant is not checked: people send each other links to
 * grants and tickets in the same form.
 *
 * @returns `null` if the fragment is something else
 */
export function parseSignInAnswer(hash: string): SignInAnswer | null {
  const members = new URLSearchParams(hash.replace(/^#/, ''));
  const state = handleSchema.safeParse(members.get('state')).data ?? null;
  const grant = members.get('grant');
  if (grant !== null) return { grant, state };
  const error = signInErrors.find((each) => each === members.get('sign-in-error'));
  return error === undefined ? null : { error, state };
}

const LOOPBACK = /^(?:localhost|127(?:\.\d{1,3}){3}|::1|\[::1\])$/;

/**
 * Whether an address stays within this machine.
 *
 * @param host a host name or an IP address, as one writes it or as `URL.hostname` has it; no other name of this machine
 */
export function isLoopbackHost(host: string): boolean {
  return LOOPBACK.test(host);
}
