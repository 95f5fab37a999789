import { describe, expect, test } from 'vitest';
import { ProtectionProfileAes128CmHmacSha1_80, SrtpSession } from 'werift';
import { deriveSrtpCmKeys } from './srtp-cm-keys.ts';
import { SrtpCmSealer } from './srtp-cm-sealer.ts';

const hex = (text: string) => Buffer.from(text, 'hex');
/** RFC 3711, appendix B.3. */
const MASTER_KEY = hex('e1f97a0d3e018be0d64fa32c06de4139');
const MASTER_SALT = hex('0ec675ad498afeebb6960b3aabe6');

describe('the session keys', () => {
  const keys = deriveSrtpCmKeys(Buffer.concat([MASTER_KEY, MASTER_SALT]));

  test('are those of RFC 3711, appendix B.3', () => {
    expect(keys.key.toString('hex')).toBe('c61e7a93744f39ee10734afe3ff7a087');
    expect(keys.salt.toString('hex')).toBe('30cbbc08863d8c85d49db34a9ae1');
    expect(keys.authenticationKey.toString('hex')).toBe('cebe321f6ff7716b6fd4ab49af256a156d38baa4');
  });

  test('need 30 bytes', () => {
    expect(() => deriveSrtpCmKeys(MASTER_KEY)).toThrow(RangeError);
  });
});

describe('sealed packets', () => {
  const SSRC = 0xdead_beef;
  const header = (sequence: number): Buffer => {
    const bytes = Buffer.alloc(12);
    bytes.writeUInt32BE((0x8060_0000 | sequence) >>> 0);
    bytes.writeUInt32BE(1234, 4);
    bytes.writeUInt32BE(SSRC, 8);
    return bytes;
  };

  test('are opened by another implementation, beyond the wrap of the sequence numbers', () => {
    const keys = deriveSrtpCmKeys(Buffer.concat([MASTER_KEY, MASTER_SALT]));
    const sealer = new SrtpCmSealer(keys, SSRC, 0x7ff0);
    const opener = new SrtpSession({
      profile: ProtectionProfileAes128CmHmacSha1_80,
      keys: {
        localMasterKey: MASTER_KEY,
        localMasterSalt: MASTER_SALT,
        remoteMasterKey: MASTER_KEY,
        remoteMasterSalt: MASTER_SALT,
      },
    });
    for (let i = 0; i < 0x8100; i++) {
      const payload = Buffer.from(`packet ${i}`);
      const head = header(sealer.nextSequence);
      const sealed = Buffer.concat(sealer.seal(head, payload));
      // Every one would take seconds.
      if (i % 97 !== 0 && i < 0x8000) continue;
      expect(opener.decrypt(sealed).subarray(12)).toEqual(payload);
    }
  });
});
