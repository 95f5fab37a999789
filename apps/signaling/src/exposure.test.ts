import { OptionsError, Secret } from '@farpoint/service';
import { describe, expect, it } from 'vitest';
import { AccessList } from './access.ts';
import { checkExposure, type ExposureOptions } from './exposure.ts';
import { judgeOrigin, type OriginPolicy } from './origin-policy.ts';
import { parseTokens } from './token-file.ts';

const closed = new AccessList(parseTokens('["a-token-of-some-length"]', false));
const open = new AccessList(null);
const tls = { cert: '', key: '' };
const local: ExposureOptions = {
  ...{ host: '127.0.0.1', open: false, plaintextTokens: false },
  ...{ reference: false, referenceOpen: false, trustProxy: [], metricsToken: null },
};
const everywhere = { ...local, host: '0.0.0.0' };

function refusal(options: ExposureOptions, files: Parameters<typeof checkExposure>[1]): string | null {
  try {
    checkExposure(options, files);
    return null;
  } catch (error) {
    if (!(error instanceof OptionsError)) throw error;
    return error.message;
  }
}

describe('a service that others reach', () => {
  it('needs tokens for robots and operators, or to be told that it is open', () => {
    expect(refusal(local, { tls: null, robots: open, operators: open })).toBeNull();
    for (const options of [
      everywhere,
      { ...everywhere, host: '::' },
      { ...local, trustProxy: ['loopback'] },
    ]) {
      const both = refusal(options, { tls, robots: open, operators: open });
      expect(both).toContain('set --robot-tokens and --operator-tokens, or --open');
      expect(refusal(options, { tls, robots: closed, operators: open })).toContain(
        'set --operator-tokens, or',
      );
      expect(refusal(options, { tls, robots: closed, operators: closed })).toBeNull();
      expect(refusal({ ...options, open: true }, { tls: null, robots: open, operators: open })).toBeNull();
    }
  });

  it('has no tokens sent in the clear, unless that is allowed', () => {
    const files = { tls: null, robots: closed, operators: closed };
    expect(refusal(everywhere, files)).toContain('--tls-cert');
    expect(refusal(local, files)).toBeNull();
    for (const cure of [{ trustProxy: ['loopback'] }, { plaintextTokens: true }])
      expect(refusal({ ...everywhere, ...cure }, files)).toBeNull();
  });

  it('has no token for metrics sent in the clear', () => {
    const options = { ...everywhere, open: true, metricsToken: new Secret('a-token-of-some-length') };
    expect(refusal(options, { tls: null, robots: open, operators: open })).toContain('--tls-cert');
    expect(refusal(options, { tls, robots: open, operators: open })).toBeNull();
  });

  it('keeps the reference system’s ports closed to strangers', () => {
    const files = { tls, robots: closed, operators: closed };
    const options = { ...everywhere, reference: true, referenceOpen: true };
    expect(refusal(options, files)).toContain('--reference-open');
    expect(refusal({ ...options, reference: false }, files)).toBeNull();
    expect(refusal({ ...options, open: true }, files)).toBeNull();
  });
});

describe('pages', () => {
  const ownNames = new Set(['x.org']);
  const isLocal: OriginPolicy = { allowed: [], isLocal: true, ownNames };
  const served: OriginPolicy = { allowed: [], isLocal: false, ownNames };
  it.each([
    // Programs that are no browsers.
    [undefined, 'x.org', served, true],
    ['https://x.org', 'x.org', served, true],
    ['https://x.org', 'x.org:443', served, true],
    ['http://10.0.0.5:3000', '10.0.0.5:3000', served, true],
    ['https://x.org:8443', 'x.org', served, false],
    ['https://evil.example', 'x.org', served, false],
    ['https://x.org.evil.example', 'x.org', served, false],
    ['null', 'x.org', served, false],
    ['https://x.org', undefined, served, false],
    ['https://evil.example', 'x.org', { ...served, allowed: ['https://evil.example'] }, true],
    ['https://evil.example', 'x.org', { ...served, allowed: ['*'] }, true],
    ['http://evil.example:3000', 'evil.example:3000', served, false],
    ['http://10.0.0.5.evil.example', '10.0.0.5.evil.example', served, false],
    // By TLS, the browser has checked that the name is the service's.
    ['https://any.example', 'any.example', { ...served, ownNames: null }, true],
    ['http://localhost:5173', 'localhost:3000', isLocal, true],
    ['http://127.0.0.1:5173', '[::1]:3000', isLocal, true],
    ['https://evil.example', '127.0.0.1:3000', isLocal, false],
    // A name of the attacker that points to this machine.
    ['http://evil.example:3000', 'evil.example:3000', isLocal, false],
    ['http://localhost:3000', 'evil.example:3000', isLocal, false],
    ['http://localhost.evil.example', 'localhost:3000', isLocal, false],
    ['http://127.0.0.1.evil.example', 'localhost:3000', isLocal, false],
    ['file://', 'localhost:3000', isLocal, false],
  ] as const)('from %s at host %s', (origin, host, policy, allowed) => {
    expect(judgeOrigin(origin, host, policy) === 'allowed').toBe(allowed);
  });
});
