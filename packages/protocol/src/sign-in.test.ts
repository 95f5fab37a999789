import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  isLoopbackHost,
  isProtectedUrl,
  parseSignInAnswer,
  parseSignInRequest,
  type SignInAnswer,
  type SignInRequest,
  type SignInRequestFault,
  signInAddress,
  signInAnswerHash,
  signInErrors,
  signInUrlSchema,
} from './sign-in.ts';
import { readVectors } from './testing/vectors.ts';

const vectors = readVectors<{
  requests: { address: string; request: SignInRequest }[];
  faults: { query: string; fault: SignInRequestFault; return: string | null }[];
  answers: { hash: string; answer: SignInAnswer }[];
  others: string[];
  'good addresses': string[];
  'bad addresses': string[];
}>('sign-in');
const KEY = 'k'.repeat(43);
const handle = fc.stringMatching(/^[A-Za-z0-9_-]{1,64}$/);

describe('the vectors', () => {
  it.each(vectors.requests)('$address', ({ address, request }) => {
    const url = new URL(address);
    expect(parseSignInRequest(url.searchParams)).toEqual({ request });
    expect(signInAddress(url.origin + url.pathname, request)).toBe(address);
  });
  it.each(vectors.faults)('$fault: $query', ({ query, fault, return: back }) => {
    expect(parseSignInRequest(new URLSearchParams(query))).toEqual({ fault, return: back });
  });
  it.each(vectors.answers)('$hash', ({ hash, answer }) => {
    expect(parseSignInAnswer(hash)).toEqual(answer);
    expect(signInAnswerHash(answer)).toBe(hash);
  });
  it.each(vectors.others)('no answer: %s', (hash) => {
    expect(parseSignInAnswer(hash)).toBeNull();
  });
  it.each(vectors['good addresses'])('an address: %s', (url) => {
    expect(signInUrlSchema.safeParse(url).success).toBe(true);
  });
  it.each(vectors['bad addresses'])('no address: %s', (url) => {
    expect(signInUrlSchema.safeParse(url).success).toBe(false);
  });
});

describe('any input', () => {
  it('is read as it was written', () => {
    fc.assert(
      fc.property(
        fc.webUrl({ withQueryParameters: true, validSchemes: ['https'] }),
        fc.option(handle),
        (back, state) => {
          const request = { key: KEY, return: back, state };
          const { searchParams } = new URL(signInAddress('https://issuer.example/sign-in', request));
          expect(parseSignInRequest(searchParams)).toEqual({ request });
        },
      ),
    );
    fc.assert(
      fc.property(fc.string(), fc.option(handle), fc.constantFrom(...signInErrors), (grant, state, error) => {
        expect(parseSignInAnswer(signInAnswerHash({ grant, state }))).toEqual({ grant, state });
        expect(parseSignInAnswer(signInAnswerHash({ error, state }))).toEqual({ error, state });
      }),
    );
  });

  it('never throws', () => {
    fc.assert(
      fc.property(fc.string(), (text) => {
        parseSignInAnswer(text);
        parseSignInRequest(new URLSearchParams(text));
        expect(isProtectedUrl(text) && !/^(https|http):/i.test(text.trim())).toBe(false);
      }),
    );
  });
});

it('knows this machine by its own names only', () => {
  for (const host of ['localhost', '127.0.0.1', '127.8.9.10', '::1', '[::1]'])
    expect(isLoopbackHost(host), host).toBe(true);
  for (const host of [
    '',
    '127.',
    '127.0.0.1.evil.example',
    'localhost.evil.example',
    '1.127.0.0',
    '10.0.0.1',
    '::',
  ])
    expect(isLoopbackHost(host), host).toBe(false);
});
