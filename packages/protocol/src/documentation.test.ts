/** Checks that the examples in docs/protocol.md are messages of this package. */
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { operatorControlCodec, robotControlCodec } from './control.ts';
import { decodeJson, type JsonCodec } from './json.ts';
import { operatorSessionCodec, robotSessionCodec } from './session-codecs.ts';
import {
  operatorToServiceCodec,
  robotToServiceCodec,
  serviceToOperatorCodec,
  serviceToRobotCodec,
} from './signaling/farpoint.ts';
import { telemetryCodec } from './telemetry.ts';

const text = readFileSync(new URL('../../../docs/protocol.md', import.meta.url), 'utf8');

const signaling = [robotToServiceCodec, serviceToRobotCodec, operatorToServiceCodec, serviceToOperatorCodec];

/** Which kinds of message the examples under a heading may be. */
const kinds: Record<string, JsonCodec<unknown>[]> = {
  '`control`, operator → robot': [operatorControlCodec],
  '`control`, robot → operator': [robotControlCodec],
  '`session`, robot → operator': [robotSessionCodec],
  '`session`, operator → robot': [operatorSessionCodec],
  '`telemetry`': [telemetryCodec],
  Signaling: signaling,
  'What robots say in the list': signaling,
};

/** Each line that begins with a brace starts a message. */
function examples(): [heading: string, example: string][] {
  const found: [string, string][] = [];
  for (const section of text.split(/^##+ /m).slice(1)) {
    const heading = section.slice(0, section.indexOf('\n'));
    for (const [, block] of section.matchAll(/```json\n(.*?)```/gs)) {
      for (const example of (block as string).split(/\n(?=\{)/)) found.push([heading, example]);
    }
  }
  return found;
}

test.each(examples())('%s: %s', (heading, example) => {
  const codecs = kinds[heading] ?? [];
  const readers = codecs.filter((codec) => {
    try {
      decodeJson(codec, example);
      return true;
    } catch {
      return false;
    }
  });
  expect(readers.length).toBeGreaterThan(0);
});

test('every section that should have examples has some', () => {
  expect(new Set(examples().map(([heading]) => heading))).toEqual(new Set(Object.keys(kinds)));
});
