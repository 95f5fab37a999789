import type { MessageDefinition } from '@foxglove/message-definition';
import { MessageReader as Ros1Reader, MessageWriter as Ros1Writer } from '@foxglove/rosmsg-serialization';
import { MessageReader, MessageWriter } from '@foxglove/rosmsg2-serialization';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
import { decoderOf } from './message-decoder.ts';
import { wireCheck } from './wire-check.ts';

const TYPES = [
  'sensor_msgs/msg/PointCloud2',
  'sensor_msgs/msg/Image',
  'sensor_msgs/msg/CameraInfo',
  'sensor_msgs/msg/BatteryState',
  'sensor_msgs/msg/NavSatFix',
  'sensor_msgs/msg/JointState',
  'nav_msgs/msg/Odometry',
  'geometry_msgs/msg/TwistStamped',
  'tf2_msgs/msg/TFMessage',
  'diagnostic_msgs/msg/DiagnosticArray',
  'std_msgs/msg/Empty',
  'std_msgs/msg/Float64MultiArray',
];

function definitions(type: string): MessageDefinition[] {
  const found = definitionsOf(2, type);
  if (found === null) throw new Error(type);
  return found;
}

/** Messages of a type, with any values. */
function messagesOf(all: readonly MessageDefinition[], of: MessageDefinition): fc.Arbitrary<unknown> {
  const anyOf = (type: string, isComplex: boolean): fc.Arbitrary<unknown> => {
    const inner = all.find(({ name }) => name === type);
    if (isComplex && inner !== undefined) return messagesOf(all, inner);
    if (type === 'string') return fc.string({ maxLength: 12 });
    if (type === 'bool') return fc.boolean();
    if (type.endsWith('int64')) return fc.bigInt({ min: 0n, max: 1000n });
    if (type.startsWith('float')) return fc.float({ noNaN: true });
    if (type === 'time' || type === 'duration')
      return fc.record({
        sec: fc.nat({ max: 2 ** 30 }),
        nanosec: fc.nat({ max: 1e9 }),
        nsec: fc.nat({ max: 1e9 }),
      });
    return fc.nat({ max: 100 });
  };
  const fields = of.definitions.filter(({ isConstant }) => isConstant !== true);
  return fc.record(
    Object.fromEntries(
      fields.map(({ name, type, isArray, arrayLength, isComplex }) => {
        const value = anyOf(type, isComplex === true);
        if (isArray !== true) return [name, value];
        const length = arrayLength ?? 5;
        return [name, fc.array(value, { minLength: arrayLength ?? 0, maxLength: length })];
      }),
    ),
  );
}

describe.each(TYPES)('%s', (type) => {
  const all = definitions(type);
  const [first] = all as [MessageDefinition];
  const check = wireCheck(all, 'cdr');
  const messages = messagesOf(all, first).map((message) => new MessageWriter(all).writeMessage(message));

  it('accepts a message as written, to its last byte', () => {
    fc.assert(
      fc.property(messages, (bytes) => {
        expect(check(bytes)).toBe(bytes.length);
      }),
      { numRuns: 50 },
    );
  });

  it('refuses a message cut short at any byte', () => {
    fc.assert(
      fc.property(messages, fc.nat(), (bytes, at) => {
        const length = at % bytes.length;
        try {
          check(bytes.subarray(0, length));
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
          expect((error as RosFault).code).toBe('bad-message');
          expect((error as RosFault).offset).toBeLessThanOrEqual(length);
          return;
        }
        throw new Error(`${length} of ${bytes.length} bytes are whole`);
      }),
      { numRuns: 100 },
    );
  });

  it('refuses random bytes, or reads to the same byte', () => {
    const reader = new MessageReader(all);
    fc.assert(
      fc.property(
        fc.uint8Array({ maxLength: 200 }),
        fc.constantFrom(0, 1, 6, 7),
        (content, representation) => {
          const bytes = Uint8Array.of(0, representation, 0, 0, ...content);
          let end: number;
          try {
            end = check(bytes);
          } catch (error) {
            expect(error).toBeInstanceOf(RosFault);
            return;
          }
          reader.readMessage(bytes);
          expect(reader.lastReadByteLength()).toBe(end);
        },
      ),
    );
  });
});

describe.each(TYPES)('%s of ROS 1', (type) => {
  const all = definitionsOf(1, type) ?? [];
  const check = wireCheck(all, 'ros1');
  const messages = messagesOf(all, all[0] as MessageDefinition).map((message) =>
    new Ros1Writer(all).writeMessage(message),
  );

  it('accepts a message to its last byte, and refuses it cut short at any byte', () => {
    fc.assert(
      fc.property(messages, fc.nat(), (bytes, at) => {
        expect(check(bytes)).toBe(bytes.length);
        if (bytes.length > 0)
          expect(() => check(bytes.subarray(0, at % bytes.length))).toThrow('is cut short');
      }),
      { numRuns: 100 },
    );
  });

  it('refuses or reads random bytes', () => {
    const reader = new Ros1Reader(all);
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 200 }), (bytes) => {
        try {
          check(bytes);
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
          return;
        }
        reader.readMessage(bytes);
      }),
    );
  });
});

it('a cloud cut short is not completed with what follows it in memory', () => {
  const type = 'sensor_msgs/msg/PointCloud2';
  const data = new Uint8Array(64).fill(7);
  const cloud = {
    ...{ header: { stamp: { sec: 1, nanosec: 2 }, frame_id: 'camera' }, height: 1, width: 4, fields: [] },
    ...{ is_bigendian: false, point_step: 16, row_step: 64, data, is_dense: true },
  };
  const bytes = new MessageWriter(definitions(type)).writeMessage(cloud);
  // Like a reused receive buffer: an older message continues behind the end of this one.
  const room = new Uint8Array(2 * bytes.length).fill(9);
  room.set(bytes.subarray(0, bytes.length - 20));
  const decode = decoderOf(2, type, null);
  expect(() => decode(room.subarray(0, bytes.length - 20))).toThrow(
    /byte \d+: the message is cut short: data needs|64 values of data/,
  );
  expect(() => decode(bytes)).not.toThrow();
});

it('a length of four thousand million allocates no memory', () => {
  const check = wireCheck(definitions('tf2_msgs/msg/TFMessage'), 'cdr');
  expect(() => check(Uint8Array.of(0, 1, 0, 0, 255, 255, 255, 255))).toThrow(
    '4294967295 values of transforms',
  );
});

it('types that cannot be read are unsupported', () => {
  const of = (type: string, isComplex: boolean) => [
    { name: 'a/B', definitions: [{ name: 'text', type, isArray: false, isComplex }] },
  ];
  expect(() => wireCheck(of('wstring', false), 'cdr')).toThrow(RosFault);
  expect(() => wireCheck(of('c/D', true), 'cdr')).toThrow(RosFault);
  const endless = wireCheck(of('a/B', true), 'cdr');
  expect(() => endless(new Uint8Array(100))).toThrow('64 deep');
});
