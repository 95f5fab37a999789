import { grantClaimsSchema } from '@farpoint/grants';
import { roles } from '@farpoint/protocol';
import { anyAddress } from '@farpoint/service/testing/any-address';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { grantFor } from './grant-for.ts';
import { personOf, subjectOf } from './person.ts';

/** Any code points: `fc.string` with the unit `binary` takes seconds to begin. */
const anyText = fc.array(fc.nat(0x10ffff), { maxLength: 300 }).map((codes) => String.fromCodePoint(...codes));

const ISSUER = 'https://login.example';
const key = 'k'.repeat(43);
const anything = fc.anything();
/** Also control characters, halves of surrogate pairs, and long texts. */
const wild = fc.oneof(anyText, fc.string({ unit: 'grapheme', maxLength: 300 }));

describe('who signed in', () => {
  it.each([
    [{ name: 'Ada Lovelace', preferred_username: 'ada' }, 'Ada Lovelace'],
    [{ name: ' ', preferred_username: 'ada' }, 'ada'],
    [{ email: 'ada@ops.example', email_verified: true }, 'ada@ops.example'],
    [{ email: 'ada@ops.example' }, 'u1'],
    [{ name: 'Ada\n\u0007\u202eLovelace\u200b' }, 'Ada Lovelace'],
    [{ name: 7 }, '7'],
    [{}, 'u1'],
  ])('%j is shown as %s', (claims, name) => {
    expect(personOf(ISSUER, 'u1', claims)).toEqual({ subject: `${ISSUER}#u1`, name });
  });

  it('is one subject for each person of each provider', () => {
    const pair = fc.tuple(anyAddress, wild);
    fc.assert(
      fc.property(pair, pair, ([a, b], [c, d]) => {
        expect(subjectOf(a, b) === subjectOf(c, d)).toBe(a === c && b === d);
        expect(subjectOf(a, b)).toBe(subjectOf(a, b));
      }),
    );
    const long = 'x'.repeat(300);
    expect(subjectOf(ISSUER, `${long}1`)).not.toBe(subjectOf(ISSUER, `${long}2`));
  });
});

describe('the grant', () => {
  it('is one, whatever the provider says', () => {
    const claims = fc.record(
      {
        name: fc.oneof(wild, anything),
        preferred_username: fc.oneof(wild, anything),
        email: wild,
        email_verified: fc.boolean(),
      },
      { requiredKeys: [] },
    );
    fc.assert(
      fc.property(wild, claims, fc.constantFrom(...roles), (sub, said, role) => {
        const terms = { issuer: 'https://issuer.example', hours: 12, robotKeys: {} };
        const grant = grantFor(personOf(ISSUER, sub, said), { role, robots: ['*'] }, terms, {
          key,
          id: 'g',
          nowS: 1e9,
        });
        expect(grantClaimsSchema.safeParse(grant).success).toBe(true);
        expect(grant.name.isWellFormed()).toBe(true);
        expect(grant).toMatchObject({ role, exp: 1e9 + 43_200, nbf: 1e9, cnf: { jkt: key } });
      }),
    );
  });

  it('names the keys of its own robots only', () => {
    const terms = { issuer: ISSUER, hours: 1, robotKeys: { 'kitchen-1': key, hall: key } };
    const grantee = { key, id: 'g', nowS: 10.7 };
    const person = { subject: 's', name: 'n' };
    expect(grantFor(person, { role: 'drive', robots: ['kitchen-*'] }, terms, grantee)).toMatchObject({
      ...{ iat: 10, exp: 3610, robotKeys: { 'kitchen-1': key } },
    });
    expect(grantFor(person, { role: 'drive', robots: ['barn'] }, terms, grantee)).not.toHaveProperty(
      'robotKeys',
    );
  });
});
