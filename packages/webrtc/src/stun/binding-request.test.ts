import { describe, expect, it } from 'vitest';
import { isAuthenticRequest, stunKind } from './binding-request.ts';

/** RFC 5769 §2.1. */
const SAMPLE_REQUEST = Buffer.from(
  '000100582112a442b7e7a701bc34d686fa87dfae' +
    '802200105354554e207465737420636c69656e74' +
    '002400046e0001ff' +
    '80290008932ff9b151263b36' +
    '000600096576746a3a68367659202020' +
    '000800149aeaa70cbfd8cb56781ef2b5b2d3f249c1b571a2' +
    '80280004e57a3bcf',
  'hex',
);
const PASSWORD = 'VOkJxbRl1RmTxUk/WvJxBt';
const passwordOf = (fragment: string) => (fragment === 'evtj' ? PASSWORD : undefined);

describe('isAuthenticRequest', () => {
  it('accepts the sample request of RFC 5769', () => {
    expect(stunKind(SAMPLE_REQUEST)).toBe('request');
    expect(isAuthenticRequest(SAMPLE_REQUEST, passwordOf)).toBe(true);
  });

  it('refuses another password, another fragment, and a missing MESSAGE-INTEGRITY', () => {
    expect(isAuthenticRequest(SAMPLE_REQUEST, () => 'another')).toBe(false);
    expect(isAuthenticRequest(SAMPLE_REQUEST, () => undefined)).toBe(false);
    const unsealed = Buffer.from(SAMPLE_REQUEST.subarray(0, SAMPLE_REQUEST.length - 32));
    unsealed.writeUInt16BE(unsealed.length - 20, 2);
    expect(isAuthenticRequest(unsealed, passwordOf)).toBe(false);
  });

  it('refuses every changed bit up to the end of the MESSAGE-INTEGRITY', () => {
    const sealed = SAMPLE_REQUEST.length - 8;
    for (let bit = 0; bit < sealed * 8; bit++) {
      const changed = Buffer.from(SAMPLE_REQUEST);
      changed[bit >> 3] = (changed[bit >> 3] as number) ^ (1 << (bit & 7));
      // The header's length is not authenticated as it stands, but a wrong one does not fit the datagram.
      if (stunKind(changed) !== 'request') continue;
      expect(isAuthenticRequest(changed, passwordOf), `bit ${bit}`).toBe(false);
    }
  });

  it('refuses attributes after the MESSAGE-INTEGRITY, which nothing authenticates', () => {
    const useCandidate = Buffer.from('00250000', 'hex');
    const appended = Buffer.concat([SAMPLE_REQUEST.subarray(0, SAMPLE_REQUEST.length - 8), useCandidate]);
    appended.writeUInt16BE(appended.length - 20, 2);
    expect(isAuthenticRequest(appended, passwordOf)).toBe(false);
  });
});

describe('stunKind', () => {
  it.each([
    ['0101', 'response'],
    ['0111', 'response'],
    ['0011', 'indication'],
    ['0001', 'request'],
  ])('recognises the class of %s', (type, kind) => {
    expect(stunKind(Buffer.concat([Buffer.from(type, 'hex'), SAMPLE_REQUEST.subarray(2)]))).toBe(kind);
  });

  it('distinguishes STUN from DTLS and RTP', () => {
    for (const first of [20, 22, 23, 63, 128, 191]) {
      expect(stunKind(Buffer.from(SAMPLE_REQUEST).fill(first, 0, 1).fill(0, 4, 8))).toBeNull();
    }
  });
});
