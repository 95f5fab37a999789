import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { parseSignalingUrl } from './signaling-url.ts';

describe('parseSignalingUrl', () => {
  test('accepts what people type', () => {
    expect(parseSignalingUrl('x.org', true)).toEqual({ url: 'wss://x.org/operator' });
    expect(parseSignalingUrl('x.org:3000', false)).toEqual({ url: 'ws://x.org:3000/operator' });
    expect(parseSignalingUrl('https://x.org/', true)).toEqual({ url: 'wss://x.org/operator' });
    expect(parseSignalingUrl('x.org/base/', true)).toEqual({ url: 'wss://x.org/base/operator' });
    expect(parseSignalingUrl('x.org/base/operator', true)).toEqual({ url: 'wss://x.org/base/operator' });
    expect(parseSignalingUrl('ws://127.0.0.1:3000', true)).toEqual({ url: 'ws://127.0.0.1:3000/operator' });
  });

  test('says why an unsafe address cannot be used', () => {
    expect(parseSignalingUrl('ws://x.org', true)).toEqual({
      reason: 'needs-wss',
      fault: 'a page served by https can only use a wss: signaling address',
    });
  });

  test('never throws', () => {
    fc.assert(
      fc.property(fc.string(), fc.boolean(), (text, secure) => {
        parseSignalingUrl(text, secure);
      }),
      { seed: 1 },
    );
  });
});
