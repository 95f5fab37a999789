import { createCipheriv, createSecretKey, randomBytes } from 'node:crypto';
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { openRecord, type RecordKeys } from './open-record.ts';
import type { DtlsRecord } from './record.ts';

const keys: RecordKeys = {
  algorithm: 'aes-128-gcm',
  key: createSecretKey(Buffer.alloc(16, 3)),
  // werift keeps the nonce of the last record behind it.
  implicitNonce: Buffer.from([1, 2, 3, 4, 9, 9, 9, 9, 9, 9, 9, 9]),
};

/** As RFC 5288 §3 says. */
function sealed(plaintext: Uint8Array, sequence: number, contentType = 23): DtlsRecord {
  const explicit = randomBytes(8);
  const cipher = createCipheriv(
    'aes-128-gcm',
    keys.key,
    Buffer.concat([Buffer.from([1, 2, 3, 4]), explicit]),
  );
  const header = Buffer.alloc(13);
  header.writeUInt16BE(1, 0);
  header.writeUIntBE(sequence, 2, 6);
  header.set([contentType, 0xfe, 0xfd, plaintext.length >> 8, plaintext.length & 255], 8);
  cipher.setAAD(header);
  const body = Buffer.concat([cipher.update(plaintext), cipher.final()]);
  const fragment = Buffer.concat([explicit, body, cipher.getAuthTag()]);
  return { contentType, version: 0xfefd, epoch: 1, sequence, fragment };
}

it('opens what was sealed, and nothing that was changed', () => {
  fc.assert(
    fc.property(
      fc.uint8Array({ maxLength: 100 }),
      fc.nat(2 ** 48 - 1),
      fc.nat(),
      fc.integer({ min: 1, max: 255 }),
      (plaintext, sequence, at, change) => {
        const record = sealed(plaintext, sequence);
        expect([...openRecord(record, keys)]).toEqual([...plaintext]);
        for (const other of [
          { contentType: 22 },
          { epoch: 2 },
          { sequence: (sequence + 1) % 2 ** 48 },
          { version: 0xfeff },
        ]) {
          expect(() => openRecord({ ...record, ...other }, keys)).toThrow('authenticate');
        }
        const fragment = Buffer.from(record.fragment);
        fragment[at % fragment.length]! ^= change;
        expect(() => openRecord({ ...record, fragment }, keys)).toThrow('authenticate');
      },
    ),
    { seed: 4, numRuns: 200 },
  );
});

it('refuses what is too short to be sealed', () => {
  const record = sealed(Buffer.alloc(0), 1);
  for (let length = 0; length < 24; length++) {
    expect(() => openRecord({ ...record, fragment: record.fragment.subarray(0, length) }, keys)).toThrow(
      RangeError,
    );
  }
  expect(openRecord(record, keys)).toHaveLength(0);
});
