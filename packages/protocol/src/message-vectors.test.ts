/** Checks every JSON codec against its conformance vectors, then against noise. */
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { broadcastCodec } from './broadcast.ts';
import { clockAnswerCodec, commandRejections, operatorControlCodec, robotControlCodec } from './control.ts';
import { ProtocolError } from './errors.ts';
import { decodeJson, encodeJson, encodeJsonBytes, type JsonCodec, type MessageData } from './json.ts';
import { referenceControlCodec } from './reference-bridge.ts';
import { commandRefusals } from './robot-command.ts';
import { operatorSessionCodec, robotSessionCodec } from './session-codecs.ts';
import { faultReasons } from './session-messages.ts';
import {
  operatorEndReasons,
  operatorToServiceCodec,
  resumeRefusals,
  robotCloseReasons,
  robotEndReasons,
  robotToServiceCodec,
  serviceToOperatorCodec,
  serviceToRobotCodec,
  signalingErrorCodes,
} from './signaling/farpoint.ts';
import {
  referenceClientToServiceCodec,
  referenceRobotToServiceCodec,
  referenceServiceToClientCodec,
  referenceServiceToRobotCodec,
} from './signaling/reference.ts';
import { driveStates, telemetryCodec } from './telemetry.ts';
import { readVectors } from './testing/vectors.ts';

const codecs: [file: string, codec: JsonCodec<unknown>][] = [
  ['operator-control', operatorControlCodec],
  ['clock-answer', clockAnswerCodec],
  ['robot-control', robotControlCodec],
  ['robot-session', robotSessionCodec],
  ['operator-session', operatorSessionCodec],
  ['telemetry', telemetryCodec],
  ['broadcast', broadcastCodec],
  ['reference-control', referenceControlCodec],
  ['signaling-robot-to-service', robotToServiceCodec],
  ['signaling-service-to-robot', serviceToRobotCodec],
  ['signaling-operator-to-service', operatorToServiceCodec],
  ['signaling-service-to-operator', serviceToOperatorCodec],
  ['reference-robot-to-service', referenceRobotToServiceCodec],
  ['reference-client-to-service', referenceClientToServiceCodec],
  ['reference-service-to-robot', referenceServiceToRobotCodec],
  ['reference-service-to-client', referenceServiceToClientCodec],
];

interface MessageVectors {
  valid: { name: string; text: string }[];
  invalid: { name: string; text?: string; hex?: string; padTo?: number; code: string; path: string }[];
}

const vectorsOf = (file: string) => readVectors<MessageVectors>(file);

/** What the decoder returns: `message`, or the error's code and path. Any other exception fails the test. */
function outcomeOf(codec: JsonCodec<unknown>, data: MessageData): { code: string; path: string } {
  try {
    decodeJson(codec, data);
    return { code: 'message', path: '' };
  } catch (error) {
    if (!(error instanceof ProtocolError)) throw error;
    expect(error.what).toBe(codec.what);
    expect(error.message).toContain(codec.what);
    return { code: error.code, path: error.path };
  }
}

describe.each(codecs)('%s', (file, codec) => {
  const { valid, invalid } = vectorsOf(file);

  test.each(valid)('$name', ({ text }) => {
    const message = decodeJson(codec, text);
    // Unknown fields are accepted only in messages of which the reference system's peers may send some.
    if (file.startsWith('reference')) expect(JSON.parse(text)).toMatchObject(message as object);
    else expect(message).toEqual(JSON.parse(text));
    expect(decodeJson(codec, new TextEncoder().encode(text))).toEqual(message);
    expect(decodeJson(codec, encodeJson(codec, message))).toEqual(message);
    expect(decodeJson(codec, encodeJsonBytes(codec, message))).toEqual(message);
  });

  test.each(invalid)('refuses: $name', ({ text, hex, padTo, code, path }) => {
    const data = text?.padEnd(padTo ?? 0) ?? new Uint8Array(Buffer.from(hex ?? '', 'hex'));
    expect(outcomeOf(codec, data)).toEqual({ code, path });
  });

  test('reads a message of exactly the maximum length', () => {
    const longest = (valid[0] as { text: string }).text.padEnd(codec.maxBytes);
    expect(outcomeOf(codec, longest).code).toBe('message');
    expect(outcomeOf(codec, new TextEncoder().encode(longest)).code).toBe('message');
  });

  test('any bytes and any JSON give a message or a ProtocolError', () => {
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 64, size: 'max' }), (bytes) => void outcomeOf(codec, bytes)),
      {
        seed: 1,
        numRuns: 200,
      },
    );
    fc.assert(
      fc.property(fc.json(), (text) => void outcomeOf(codec, text)),
      { seed: 2, numRuns: 200 },
    );
  });

  test('a valid message with any one value replaced gives a message or a ProtocolError', () => {
    const refused = { count: 0 };
    fc.assert(
      fc.property(fc.constantFrom(...valid), fc.nat(), fc.jsonValue(), ({ text }, at, value) => {
        const message = JSON.parse(text) as unknown;
        const holes = placesIn(message);
        const [holder, key] = holes[at % holes.length] as [Record<string, unknown>, string];
        holder[key] = value;
        if (outcomeOf(codec, JSON.stringify(message)).code === 'invalid') refused.count++;
      }),
      { seed: 3, numRuns: 400 },
    );
    expect(refused.count).toBeGreaterThan(100);
  });

  test('a valid message with any byte changed gives a message or a ProtocolError', () => {
    fc.assert(
      fc.property(fc.constantFrom(...valid), fc.nat(), fc.nat(255), ({ text }, at, byte) => {
        const bytes = new TextEncoder().encode(text);
        bytes[at % bytes.length] = byte;
        outcomeOf(codec, bytes);
      }),
      { seed: 4, numRuns: 300 },
    );
  });
});

test.each([
  ['robot-session', 'reason', [...commandRejections, ...faultReasons, ...commandRefusals]],
  ['telemetry', 'drive', driveStates],
  ['signaling-service-to-robot', 'code', signalingErrorCodes],
  ['signaling-service-to-robot', 'reason', operatorEndReasons],
  ['signaling-robot-to-service', 'reason', robotCloseReasons],
  ['signaling-robot-to-service', 'code', resumeRefusals],
  ['signaling-service-to-operator', 'reason', robotEndReasons],
])('the vectors of %s have every %s', (file, member, all) => {
  const values = vectorsOf(file).valid.map(
    ({ text }) => (JSON.parse(text) as Record<string, unknown>)[member],
  );
  expect(new Set(values.filter((value) => value !== undefined))).toEqual(new Set<unknown>(all));
});

/** Every object or array member in a JSON value. */
function placesIn(value: unknown): [object, string][] {
  if (typeof value !== 'object' || value === null) return [];
  return Object.entries(value).flatMap(([key, inner]) => [
    [value, key] as [object, string],
    ...placesIn(inner),
  ]);
}
