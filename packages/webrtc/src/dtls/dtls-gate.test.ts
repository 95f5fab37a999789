import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { Refusals } from '../refusal.ts';
import { dtlsRecord } from '../testing/dtls-record.ts';
import { type DtlsEndpoint, DtlsGate } from './dtls-gate.ts';
import { serializeHandshake } from './handshake-message.ts';

/** Records every call. A record decrypts if its fragment begins with a 1. */
class FakeEndpoint implements DtlsEndpoint {
  readonly role: 'server' | 'client';
  readonly fingerprints = [{ algorithm: 'sha-256', value: '00' }];
  readonly cookie = Buffer.from('cookie');
  masterSecret: Buffer | null = null;
  readonly randoms = Buffer.alloc(64);
  readonly calls: string[] = [];

  constructor(role: 'server' | 'client') {
    this.role = role;
  }

  transcript(): Buffer {
    return Buffer.alloc(0);
  }

  decrypt({ fragment }: { fragment: Buffer }): Buffer {
    if (fragment[0] !== 1) throw new Error('not authentic');
    return fragment.subarray(1);
  }

  onHandshake({ type }: { type: number }): void {
    this.calls.push(`handshake ${type}`);
  }

  resendFlight(): void {
    this.calls.push('resend');
  }

  onData(): void {
    this.calls.push('data');
  }

  onClosed(): void {
    this.calls.push('closed');
  }

  onFailed(): void {
    this.calls.push('failed');
  }
}

function hello(messageSequence: number, cookie: string, random = 7): Buffer {
  const body = Buffer.concat([
    Buffer.from([0xfe, 0xfd]),
    Buffer.alloc(32, random),
    Buffer.from([0, cookie.length]),
    Buffer.from(cookie),
    Buffer.from([0, 2, 0xc0, 0x2b, 1, 0]),
  ]);
  return dtlsRecord(22, 0, messageSequence, serializeHandshake({ type: 1, messageSequence, body }));
}

const types = fc.constantFrom(1, 2, 3, 11, 12, 13, 14, 15, 16, 20, 77);
const handshakes = fc
  .record({ type: types, messageSequence: fc.nat(3), body: fc.uint8Array({ maxLength: 40 }) })
  .map(({ body, ...rest }) => serializeHandshake({ ...rest, body: Buffer.from(body) }));
const datagrams = fc
  .record({
    contentType: fc.integer({ min: 19, max: 24 }),
    epoch: fc.nat(2),
    sequence: fc.nat(100),
    fragment: fc.oneof(fc.uint8Array({ minLength: 1, maxLength: 60 }), handshakes),
  })
  .map(({ contentType, epoch, sequence, fragment }) => dtlsRecord(contentType, epoch, sequence, fragment));

describe('DtlsGate', () => {
  it('never throws, and without keys passes on neither data nor a close, whatever arrives', () => {
    fc.assert(
      fc.property(
        fc.constantFrom('server', 'client'),
        fc.array(datagrams, { maxLength: 20 }),
        (role, all) => {
          const endpoint = new FakeEndpoint(role as 'server' | 'client');
          const gate = new DtlsGate(endpoint, new Refusals());
          for (const datagram of all) gate.onDatagram(datagram);
          gate.onDatagram(Buffer.concat(all).subarray(3));
          expect(gate.connected).toBe(false);
          expect(endpoint.calls).not.toContain('data');
          expect(endpoint.calls).not.toContain('closed');
          // A handshake gets as far as the first proof and no further.
          for (const late of [12, 15, 20]) expect(endpoint.calls).not.toContain(`handshake ${late}`);
        },
      ),
      { seed: 7, numRuns: 1000 },
    );
  });

  it('accepts a second hello that is the first plus the cookie, and repeats its flight for a repeated one', () => {
    const endpoint = new FakeEndpoint('server');
    const refusals = new Refusals();
    const gate = new DtlsGate(endpoint, refusals);
    gate.onDatagram(hello(0, ''));
    gate.onDatagram(hello(0, ''));
    expect(endpoint.calls).toEqual(['handshake 1', 'resend']);
    gate.onDatagram(hello(1, 'another'));
    gate.onDatagram(hello(1, 'cookie', 8));
    expect(refusals.get('dtls-out-of-order')).toBe(2);
    gate.onDatagram(hello(1, 'cookie'));
    expect(endpoint.calls).toEqual(['handshake 1', 'resend', 'handshake 1']);
    gate.onDatagram(hello(2, 'cookie'));
    expect(refusals.get('dtls-out-of-order')).toBe(3);
  });

  it('does not repeat its flight for ever', () => {
    const endpoint = new FakeEndpoint('server');
    const gate = new DtlsGate(endpoint, new Refusals());
    for (let n = 0; n < 100; n++) gate.onDatagram(hello(0, ''));
    expect(endpoint.calls.filter((call) => call === 'resend')).toHaveLength(20);
  });

  it('keeps a few encrypted records that overtook the keys, and counts the rest', () => {
    const refusals = new Refusals();
    const gate = new DtlsGate(new FakeEndpoint('server'), refusals);
    for (let n = 0; n < 6; n++) gate.onDatagram(dtlsRecord(23, 1, n, Buffer.from([1, 2])));
    expect(refusals.get('dtls-early')).toBe(2);
  });

  it('ends on an authentic alert that is fatal or a close, but not on a warning', () => {
    const endpoint = new FakeEndpoint('server');
    const gate = new DtlsGate(endpoint, new Refusals());
    endpoint.masterSecret = Buffer.alloc(48);
    gate.onDatagram(dtlsRecord(21, 1, 1, Buffer.from([1, 1, 90])));
    gate.onDatagram(dtlsRecord(21, 1, 2, Buffer.from([9, 2, 40])));
    expect(endpoint.calls).toEqual([]);
    gate.onDatagram(dtlsRecord(21, 1, 3, Buffer.from([1, 2, 40])));
    gate.onDatagram(dtlsRecord(21, 1, 4, Buffer.from([1, 1, 0])));
    expect(endpoint.calls).toEqual(['closed']);
  });
});
