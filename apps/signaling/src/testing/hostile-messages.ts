/** For tests: what hostile peers send to the service, and valid messages to damage. */

/** A message of each type that the service reads, on all its ports. */
export const protocolMessages = [
  { type: 'robot.hello', protocol: 1, id: 'bystander', name: 'x', key: 'k' },
  { type: 'operator.hello', protocol: 1, name: 'x' },
  { type: 'session.open', robotId: 'bystander' },
  { type: 'session.offer', session: 's', sdp: 'v=0' },
  { type: 'session.answer', session: 's', sdp: 'v=0' },
  { type: 'session.candidate', session: 's', candidate: { candidate: 'c', sdpMid: '0' } },
  { type: 'session.close', session: 's', reason: 'silent' },
  { type: 'session.resume', session: 's', robotId: 'bystander', resumeKey: 'k' },
  { type: 'session.refuse', session: 's', claim: 'c', code: 'unknown-session' },
  { type: 'register', name: 'x', sdpOffer: 'v=0' },
  { type: 'offer', robotId: 0, sdpOffer: 'evil' },
  { type: 'deregister', robotId: 0 },
  { type: 'getRobots' },
  { type: 'answer', robotId: 0, sdpAnswer: 'x' },
];

/** Texts that have crashed such services before. */
export const hostileTexts: readonly string[] = [
  ...['null', 'undefined', '[]', '{}', '0', '""', 'true', '{"type":null}', '{"type":"__proto__"}'],
  '{"__proto__":{"type":"getRobots"}}',
  '{"type":"register","name":"\\u0000\\ud800","sdpOffer":"x"}',
];

/** Nested deeply, or long. */
export const hugeTexts: readonly string[] = [
  '['.repeat(60_000),
  `{"type":${'{"a":'.repeat(10_000)}1${'}'.repeat(10_000)}}`,
];

/** Frames that break RFC 6455, with the close code that each deserves. */
export const hostileFrames: readonly { what: string; bytes: readonly number[]; code: number }[] = [
  { what: 'text that is not UTF-8', bytes: [0x81, 0x82, 0, 0, 0, 0, 0xff, 0xff], code: 1007 },
  { what: 'an unmasked frame', bytes: [0x81, 0x01, 0x41], code: 1002 },
  { what: 'a reserved opcode', bytes: [0x83, 0x80, 0, 0, 0, 0], code: 1002 },
  { what: 'reserved bits', bytes: [0xf1, 0x80, 0, 0, 0, 0], code: 1002 },
];

const UPGRADE = 'Host: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n';
/** Requests for a WebSocket that deserve a status of 400 or more. */
export const hostileHandshakes: readonly string[] = [
  `GET /robot HTTP/1.1\r\n${UPGRADE}\r\n`,
  `GET /robot HTTP/1.1\r\n${UPGRADE}Sec-WebSocket-Key: x\r\nSec-WebSocket-Version: 99\r\n\r\n`,
  `GET //[ HTTP/1.1\r\n${UPGRADE}\r\n`,
  'GET http://[ HTTP/1.1\r\nHost: x\r\nUpgrade: h2c\r\nConnection: Upgrade\r\n\r\n',
];
