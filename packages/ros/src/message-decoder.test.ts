import { describe, expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import { decoderOf, lazyDecoder } from './message-decoder.ts';
import { messageBytes } from './testing/memory-graph.ts';

const IMAGE = 'sensor_msgs/msg/Image';
const image = {
  header: { seq: 0, stamp: { sec: 1, nsec: 2, nanosec: 2 }, frame_id: 'camera' },
  ...{
    height: 2,
    width: 3,
    encoding: 'mono8',
    is_bigendian: 0,
    step: 3,
    data: Uint8Array.of(1, 2, 3, 4, 5, 6),
  },
};

describe.each([1, 2] as const)('decoderOf, ROS %i', (version) => {
  const bytes = messageBytes(version, IMAGE, image);
  const decode = decoderOf(version, IMAGE, null);

  it('reads a message at any position in memory', () => {
    for (let lead = 0; lead < 4; lead++) {
      const room = new Uint8Array(bytes.length + 100);
      room.set(bytes, lead);
      expect(decode(room.subarray(lead, lead + bytes.length))).toMatchObject({ width: 3, data: image.data });
    }
  });

  it('refuses a message cut short anywhere, even if others follow in memory', () => {
    const room = new Uint8Array(bytes.length + 100).fill(0xee);
    room.set(bytes);
    for (let length = 0; length < bytes.length; length++) {
      expect(() => decode(room.subarray(0, length)), String(length)).toThrow(RosFault);
    }
    expect(() => decode(room.subarray(0, bytes.length - 2))).toThrow(/data needs 6 bytes, and 4 are left/);
  });
});

describe('found by fuzzing', () => {
  const decode = decoderOf(2, IMAGE, null);
  const bytes = messageBytes(2, IMAGE, image);

  it.each([0x005d, 0x0093, 0x007f, 0x2200, 0x0003, 0x0010, 0xff01])('refuses encapsulation %i', (kind) => {
    const other = Uint8Array.from(bytes);
    new DataView(other.buffer).setUint16(0, kind);
    expect(() => decode(other)).toThrow(/encapsulation 0x[0-9a-f]{4} is none of CDR/);
  });

  it('refuses a definition that refers to nothing, in a message of its own', () => {
    expect(() => decoderOf(1, 'own/Type', 'uint3eader header')).toThrow(RosFault);
    expect(() => decoderOf(1, 'own/Type', 'not a definition at all')).toThrow(/definition is unreadable/);
  });
});

describe('a recording without definitions', () => {
  const of = (name: string, messageEncoding: 'cdr' | 'ros1', text = '') =>
    lazyDecoder({ name, messageEncoding, schemaEncoding: '', schema: new TextEncoder().encode(text) });

  it.each(['cdr', 'ros1'] as const)('is read if ROS has its types, in %s', (encoding) => {
    const bytes = messageBytes(encoding === 'cdr' ? 2 : 1, IMAGE, image);
    expect(of(IMAGE, encoding)(bytes)).toMatchObject({ width: 3, data: image.data });
    expect(of(IMAGE, encoding, ' \n')(bytes)).toMatchObject({ width: 3 });
  });

  it('says so if it has not', () => {
    const read = (name: string) => () => of(name, 'cdr')(new Uint8Array(8));
    expect(read('own/msg/Type')).toThrow(
      'the schema is empty: there is no definition of own/msg/Type with them',
    );
    expect(read('')).toThrow('the schema is empty: its messages have no type');
  });
});
