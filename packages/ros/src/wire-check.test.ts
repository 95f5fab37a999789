import { thrown } from '@farpoint/service/testing/thrown';
import type { MessageDefinition } from '@foxglove/message-definition';
import { MessageReader as Ros1Reader, MessageWriter as Ros1Writer } from '@foxglove/rosmsg-serialization';
import { MessageReader, MessageWriter } from '@foxglove/rosmsg2-serialization';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
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

function definitions(type: string, version: 1 | 2 = 2): MessageDefinition[] {
  const found = definitionsOf(version, type);
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

describe.each(TYPES.flatMap((type) => [[type, 2] as const, [type, 1] as const]))(
  '%s of ROS %i',
  (type, version) => {
    const all = definitions(type, version);
    const check = wireCheck(all, version === 1 ? 'ros1' : 'cdr');
    const [writer, reader] =
      version === 1
        ? [new Ros1Writer(all), new Ros1Reader(all)]
        : [new MessageWriter(all), new MessageReader(all)];
    const messages = messagesOf(all, all[0]!).map((message) => writer.writeMessage(message));

    it('accepts a message to its last byte, and refuses it cut short at any byte', () => {
      fc.assert(
        fc.property(messages, fc.nat(), (bytes, at) => {
          expect(check(bytes)).toBe(bytes.length);
          if (bytes.length === 0) return;
          const length = at % bytes.length;
          const { code, offset } = thrown(RosFault, () => check(bytes.subarray(0, length)));
          expect(code).toBe('bad-message');
          expect(offset).toBeLessThanOrEqual(length);
        }),
        { numRuns: 100 },
      );
    });

    it('refuses random bytes, or reads to the same byte', () => {
      const kinds = fc.constantFrom(0, 1, 6, 7);
      fc.assert(
        fc.property(fc.uint8Array({ maxLength: 200 }), kinds, (content, kind) => {
          const bytes = version === 1 ? content : Uint8Array.of(0, kind, 0, 0, ...content);
          let end: number;
          try {
            end = check(bytes);
          } catch (error) {
            expect(error).toBeInstanceOf(RosFault);
            return;
          }
          reader.readMessage(bytes);
          if (reader instanceof MessageReader) expect(reader.lastReadByteLength()).toBe(end);
        }),
      );
    });
  },
);

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
