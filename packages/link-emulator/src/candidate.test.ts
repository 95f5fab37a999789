import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  candidateFaults,
  type Endpoint,
  endpointsOf,
  readCandidate,
  rewriteSdp,
  standIn,
} from './candidate.ts';

const away: Endpoint = { address: '127.0.0.1', port: 4000 };

/** @throws {Error} if it cannot be read */
function lead(text: string, to = away): string {
  const candidate = readCandidate(text);
  if (typeof candidate === 'string') throw new Error(candidate);
  return standIn(candidate, to);
}

test.each([
  [
    'candidate:1 1 udp 2130706431 192.0.2.2 50000 typ host',
    'candidate:1 1 udp 2130706431 127.0.0.1 4000 typ host',
  ],
  [
    'a=candidate:842163049 1 UDP 1677729535 203.0.113.9 61234 typ srflx raddr 10.0.0.5 rport 50000 generation 0 ufrag x',
    'a=candidate:842163049 1 UDP 1677729535 127.0.0.1 4000 typ srflx raddr 0.0.0.0 rport 9 generation 0 ufrag x',
  ],
  ['1 1 udp 1 fd00::2 9999 typ host', '1 1 udp 1 127.0.0.1 4000 typ host'],
])('only the endpoint of a candidate changes: %s', (text, led) => {
  expect(lead(text)).toBe(led);
});

test.each([
  ['candidate:1 1 tcp 1 192.0.2.2 9 typ host tcptype active', 'not-udp'],
  ['candidate:1 1 udp 1 5f1c2d6e-1f2a-4b7c-9d3e-0a1b2c3d4e5f.local 50000 typ host', 'mdns'],
  ['candidate:1 1 udp 1 robot.example.org 50000 typ host', 'hostname'],
  ['candidate:1 1 udp 1 fe80::1 50000 typ host', 'link-local'],
  ['candidate:1 1 udp 1 169.254.7.7 50000 typ host', 'link-local'],
  ['candidate:1 1 udp 1 192.0.2.2 0 typ host', 'malformed'],
  ['candidate:1 1 udp 1 192.0.2.2 70000 typ host', 'malformed'],
  ['candidate:1 1 udp 1 192.0.2.2 5 typ host\r\na=candidate:2 1 udp 1 192.0.2.3 5 typ host', 'malformed'],
  ['', 'malformed'],
])('a candidate that cannot be routed says why: %s', (text, fault) => {
  expect(readCandidate(text)).toBe(fault);
});

const octet = fc.integer({ min: 0, max: 255 });
const address = fc.oneof(
  fc.ipV4(),
  fc.ipV6(),
  fc.tuple(octet, octet).map(([a, b]) => `10.1.${a}.${b}`),
);
const candidateText = fc
  .record({
    prefix: fc.constantFrom('', 'candidate:', 'a=candidate:'),
    foundation: fc.stringMatching(/^[A-Za-z0-9+/]{1,32}$/),
    transport: fc.constantFrom('udp', 'UDP', 'tcp', 'ssltcp'),
    address: fc.oneof(address, fc.constant('x.local'), fc.string({ minLength: 1 })),
    port: fc.oneof(fc.integer({ min: 0, max: 70_000 }), fc.string()),
    rest: fc.constantFrom('', ' raddr 10.0.0.5 rport 50000', ' generation 0 network-cost 999'),
  })
  .map(
    ({ prefix, foundation, transport, address, port, rest }) =>
      `${prefix}${foundation} 1 ${transport} 2130706431 ${address} ${port} typ srflx${rest}`,
  );

test('any text gives a candidate or a typed fault; a rewritten candidate reads back with its new endpoint', () => {
  fc.assert(
    fc.property(fc.oneof(fc.string(), candidateText), (text) => {
      const read = readCandidate(text);
      if (typeof read === 'string') {
        expect(candidateFaults).toContain(read);
        return;
      }
      const led = readCandidate(standIn(read, away));
      expect(led).toMatchObject({ endpoint: away });
      // Rewriting it back gives the same text, except for the removed base.
      expect(lead(standIn(read, away), read.endpoint)).toBe(lead(text, read.endpoint));
    }),
    { seed: 4, numRuns: 2000 },
  );
});

const SDP = [
  'v=0',
  'o=- 1 2 IN IP4 127.0.0.1',
  's=-',
  'm=audio 50000 UDP/TLS/RTP/SAVPF 96',
  'c=IN IP4 192.0.2.2',
  'a=rtcp:50001 IN IP4 192.0.2.2',
  'a=candidate:1 1 udp 2130706431 192.0.2.2 50000 typ host',
  'a=candidate:2 1 tcp 2130706431 192.0.2.2 9 typ host tcptype active',
  'a=candidate:3 1 udp 2130706431 abc.local 50000 typ host',
  'm=video 0 UDP/TLS/RTP/SAVPF 97',
  'c=IN IP6 fd00::2',
  'a=mid:1',
  '',
].join('\r\n');

test('a description keeps its lines but names no address of its peer', () => {
  const faults: string[] = [];
  expect(endpointsOf(SDP)).toEqual([{ address: '192.0.2.2', port: 50_000 }]);
  const led = rewriteSdp(
    SDP,
    () => away,
    (fault) => faults.push(fault),
  );
  expect(led.split('\r\n')).toEqual([
    'v=0',
    'o=- 1 2 IN IP4 127.0.0.1',
    's=-',
    'm=audio 9 UDP/TLS/RTP/SAVPF 96',
    'c=IN IP4 0.0.0.0',
    'a=rtcp:9 IN IP4 0.0.0.0',
    'a=candidate:1 1 udp 2130706431 127.0.0.1 4000 typ host',
    'm=video 0 UDP/TLS/RTP/SAVPF 97',
    'c=IN IP6 ::',
    'a=mid:1',
    '',
  ]);
  expect(faults).toEqual(['not-udp', 'mdns']);
  expect(
    endpointsOf(
      rewriteSdp(
        SDP,
        () => null,
        () => {},
      ),
    ),
  ).toEqual([]);
});

test('only placed endpoints remain of any description', () => {
  const line = fc.oneof(
    fc.string(),
    candidateText,
    candidateText.map((text) => `a=candidate:${text.replace(/^.*candidate:/, '')}`),
    fc.constantFrom(...SDP.split('\r\n')),
  );
  fc.assert(
    fc.property(fc.array(line), fc.constantFrom('\n', '\r\n', '\r'), (lines, end) => {
      const sdp = lines.join(end);
      const places = endpointsOf(sdp).length;
      const led = rewriteSdp(
        sdp,
        () => away,
        () => {},
      );
      expect(endpointsOf(led)).toEqual(Array.from({ length: places }, () => away));
      // Applying it twice equals applying it once.
      expect(
        rewriteSdp(
          led,
          (endpoint) => endpoint,
          () => {},
        ),
      ).toBe(led);
    }),
    { seed: 5 },
  );
});
