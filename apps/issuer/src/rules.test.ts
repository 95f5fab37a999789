import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Claims, claimTexts, type Rule, ruleFor, ruleSchema } from './rules.ts';

const rule = (claim: string, value: string, role: Rule['role'] = 'drive'): Rule => ({
  claim,
  value,
  role,
  robots: ['*'],
});
const anything = fc.anything({ withNullPrototype: true });

describe('claims as texts', () => {
  it.each<[string, string, Claims, string[]]>([
    ['text', 'department', { department: 'ops' }, ['ops']],
    ['a list', 'groups', { groups: ['a', 7, true, null, {}, ['b']] }, ['a', '7', 'true']],
    ['within an object', 'realm_access.roles', { realm_access: { roles: ['driver'] } }, ['driver']],
    ['a name with dots', 'https://a.example/roles', { 'https://a.example/roles': ['x'] }, ['x']],
    ['nothing', 'groups', {}, []],
    ['an object', 'address', { address: { country: 'DE' } }, []],
    ['inherited', 'constructor.name', {}, []],
    ['a list’s length', 'groups.length', { groups: ['a'] }, []],
    ['a verified address', 'email', { email: 'a@b.example', email_verified: true }, ['a@b.example']],
    ['an address that is not verified', 'email', { email: 'a@b.example', email_verified: false }, []],
    ['an address of which nothing is said', 'email', { email: 'a@b.example' }, []],
    [
      'an address said to be verified in words',
      'email',
      { email: 'a@b.example', email_verified: 'true' },
      [],
    ],
  ])('%s', (_, name, claims, texts) => {
    expect(claimTexts(claims, name)).toEqual(texts);
  });

  it('any claims are read without an exception', () => {
    fc.assert(
      fc.property(fc.dictionary(fc.string(), anything), fc.string(), (claims, name) => {
        for (const text of claimTexts(claims, name)) expect(typeof text).toBe('string');
      }),
    );
  });
});

describe('rules', () => {
  const rules = [rule('groups', 'chiefs', 'supervise'), rule('groups', 'team-*'), rule('sub', '*', 'watch')];

  it.each<[Claims, Rule['role'] | null]>([
    [{ groups: ['team-1', 'chiefs'] }, 'supervise'],
    [{ groups: 'team-1', sub: 'x' }, 'drive'],
    [{ groups: ['Chiefs', 'a-team-1'], sub: 'x' }, 'watch'],
    [{ groups: ['a-team-1'] }, null],
    [{}, null],
  ])('the first that matches decides: %j', (claims, role) => {
    expect(ruleFor(rules, claims)?.role ?? null).toBe(role);
  });

  it('the first that matches alone matches in the list; rules after it change nothing', () => {
    const value = fc.constantFrom('a', 'b', 'a*', '*b', '*');
    const some = fc.array(fc.record({ claim: fc.constantFrom('g', 'h'), value }), { maxLength: 6 });
    const claims = fc.record({
      g: fc.array(fc.constantFrom('a', 'b', 'ab')),
      h: fc.constantFrom('a', 'b', 'c'),
    });
    fc.assert(
      fc.property(some, claims, (given, said) => {
        const list = given.map(({ claim, value: each }) => rule(claim, each));
        expect(ruleFor(list, said)).toBe(list.find((each) => ruleFor([each], said) !== null) ?? null);
      }),
    );
  });

  it('a value without * matches itself only', () => {
    const plain = fc.string({ minLength: 1 }).filter((text) => !text.includes('*'));
    fc.assert(
      fc.property(plain, plain, (value, said) => {
        expect(ruleFor([rule('g', value)], { g: [said] }) !== null).toBe(value === said);
      }),
    );
  });

  it.each([
    [{ claim: 'g', value: 'a', role: 'admin', robots: ['*'] }],
    [{ claim: 'g', value: 'a', role: 'drive', robots: [] }],
    [{ claim: 'g', value: 'a', role: 'drive', robots: ['Kitchen'] }],
    [{ claim: 'g', value: '', role: 'drive', robots: ['*'] }],
    [{ claim: 'g', value: 'a', role: 'drive', robots: ['*'], allow: true }],
    [{ value: 'a', role: 'drive', robots: ['*'] }],
  ])('is none: %j', (given) => {
    expect(ruleSchema.safeParse(given).success).toBe(false);
  });
});
