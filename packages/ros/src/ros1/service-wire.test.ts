import { createHash } from 'node:crypto';
import fc from 'fast-check';
import { expect, it, test } from 'vitest';
import { RosFault } from '../fault.ts';
import { SERVICE_TYPES } from '../std-services.ts';
import { readServiceReply, SERVICE_SUMS, serviceRequest } from './service-types.ts';
import {
  connectionHeader,
  framed,
  MOST_SERVICE_BYTES,
  readConnectionHeader,
  readServiceAnswer,
} from './service-wire.ts';

const text = (value: string) => new TextEncoder().encode(value);
const answer = (ok: number, payload: Uint8Array) => Uint8Array.of(ok, ...framed(payload));

it('writes a connection’s header as TCPROS has it, and reads it back', () => {
  expect([...connectionHeader({ a: 'b=c' })]).toEqual([9, 0, 0, 0, 5, 0, 0, 0, ...text('a=b=c')]);
  const fields = { callerid: '/robot', service: '/dock', md5sum: '*' };
  const bytes = connectionHeader(fields);
  expect(readConnectionHeader(bytes)).toEqual({
    fields: new Map(Object.entries(fields)),
    length: bytes.length,
  });
});

it('waits for the rest, wherever header and answer are cut', () => {
  const header = connectionHeader({ callerid: '/x', error: 'no' });
  const said = answer(0, text('the door is open'));
  for (let cut = 0; cut < header.length; cut++)
    expect(readConnectionHeader(header.subarray(0, cut))).toBeNull();
  for (let cut = 0; cut < said.length; cut++) expect(readServiceAnswer(said.subarray(0, cut))).toBeNull();
  expect(readServiceAnswer(said)).toEqual({ ok: false, payload: text('the door is open') });
});

test.each<[string, () => unknown]>([
  ['a header that claims too much', () => readConnectionHeader(Uint8Array.of(1, 0, 1, 0))],
  ['a field longer than its header', () => readConnectionHeader(framed(framed(text('a=b')).subarray(0, 6)))],
  ['a field without a name', () => readConnectionHeader(framed(framed(text('=b'))))],
  ['an answer that is neither', () => readServiceAnswer(Uint8Array.of(2, 0, 0, 0, 0))],
  ['an answer that claims too much', () => readServiceAnswer(Uint8Array.of(1, 0, 0, 0, 255))],
  ['a reply with a wrong length', () => readServiceReply('std_srvs/Trigger', Uint8Array.of(1, 9, 0, 0, 0))],
  ['a reply that is cut', () => readServiceReply('std_srvs/SetBool', Uint8Array.of(1))],
  ['a reply of something empty', () => readServiceReply('std_srvs/Empty', Uint8Array.of(1))],
])('%s is refused', (_, read) => {
  expect(read).toThrow(RosFault);
});

it('knows its services by the sums of their definitions, and what they answer', () => {
  const reply = 'bool success\nstring message';
  const definitions = {
    'std_srvs/Empty': '',
    'std_srvs/Trigger': reply,
    'std_srvs/SetBool': `bool data${reply}`,
  };
  for (const type of SERVICE_TYPES)
    expect(SERVICE_SUMS[type]).toBe(createHash('md5').update(definitions[type]).digest('hex'));
  expect(serviceRequest('std_srvs/SetBool', true)).toEqual(Uint8Array.of(1));
  expect(serviceRequest('std_srvs/Trigger', true)).toEqual(new Uint8Array());
  expect(readServiceReply('std_srvs/Trigger', Uint8Array.of(1, 2, 0, 0, 0, 104, 105))).toEqual({
    ...{ success: true, message: 'hi' },
  });
  expect(readServiceReply('std_srvs/Empty', new Uint8Array())).toEqual({ success: true, message: '' });
});

it('reads any bytes, or refuses them by a RosFault', () => {
  const readers = [
    readConnectionHeader,
    readServiceAnswer,
    (bytes: Uint8Array) => readServiceReply('std_srvs/Trigger', bytes),
  ];
  fc.assert(
    fc.property(fc.constantFrom(...readers), fc.uint8Array({ maxLength: 64, size: 'max' }), (read, bytes) => {
      try {
        read(bytes);
      } catch (error) {
        expect(error).toBeInstanceOf(RosFault);
      }
    }),
    { seed: 2, numRuns: 500 },
  );
  expect(MOST_SERVICE_BYTES).toBeLessThan(2 ** 20);
});
