import fc from 'fast-check';
import { expect, it, test } from 'vitest';
import { RosFault } from './fault.ts';
import { readStdServiceReply, SERVICE_TYPES, stdServiceRequest, stdServiceTypes } from './std-services.ts';

it('have the names of ROS 2’s messages', () => {
  expect(stdServiceTypes('std_srvs/SetBool')).toEqual({
    request: 'std_srvs/srv/SetBool_Request',
    reply: 'std_srvs/srv/SetBool_Response',
  });
});

test.each([
  ['std_srvs/Empty', true, 0],
  ['std_srvs/Trigger', true, 0],
  ['std_srvs/SetBool', false, 0],
  ['std_srvs/SetBool', true, 1],
] as const)('%s with %s is asked with one byte', (type, data, byte) => {
  expect([...stdServiceRequest(type, data)]).toEqual([0, 1, 0, 0, byte]);
});

it('are answered with a truth and a sentence', () => {
  // The length of the text, with its zero, begins at the fourth byte behind the header.
  const yes = Uint8Array.of(0, 1, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 111, 107, 0);
  const no = Uint8Array.of(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0);
  for (const type of ['std_srvs/Trigger', 'std_srvs/SetBool'] as const) {
    expect(readStdServiceReply(type, yes)).toEqual({ success: true, message: 'ok' });
    expect(readStdServiceReply(type, no)).toEqual({ success: false, message: '' });
  }
  expect(readStdServiceReply('std_srvs/Empty', Uint8Array.of(0, 1, 0, 0, 0))).toEqual({
    success: true,
    message: '',
  });
});

test.each([
  ['nothing', 'std_srvs/Empty', [0, 1, 0, 0]],
  ['a text that is cut', 'std_srvs/Trigger', [0, 1, 0, 0, 1, 0, 0, 0, 9, 0, 0, 0, 111]],
  ['a length near 2³²', 'std_srvs/Trigger', [0, 1, 0, 0, 1, 0, 0, 0, 255, 255, 255, 255, 0]],
  ['no truth', 'std_srvs/SetBool', [0, 1, 0, 0, 7, 0, 0, 0, 1, 0, 0, 0, 0]],
] as const)('an answer that has %s is refused', (_, type, bytes) => {
  expect(() => readStdServiceReply(type, Uint8Array.from(bytes))).toThrow(
    expect.objectContaining({ code: 'bad-message' }),
  );
});

it('whatever is answered, nothing but a fault is thrown', () => {
  fc.assert(
    fc.property(fc.constantFrom(...SERVICE_TYPES), fc.uint8Array({ maxLength: 40 }), (type, bytes) => {
      // Half of them begin as they should.
      for (const each of [bytes, Uint8Array.of(0, 1, 0, 0, ...bytes)]) {
        try {
          readStdServiceReply(type, each);
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
        }
      }
    }),
  );
});
