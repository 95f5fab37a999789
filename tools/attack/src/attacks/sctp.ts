import { dataChunk, malformedChunks, sctpPacket } from '@farpoint/webrtc/testing';
import { attacks } from '../attack.ts';
import { inTime, pause } from '../harm.ts';
import { Noise } from '../noise.ts';
import type { Scene } from '../scene.ts';
import { SctpGuest } from '../sctp-guest.ts';

function withGuest(act: (guest: SctpGuest) => Promise<void>): (scene: Scene) => Promise<void> {
  return async (scene) => {
    await act(await SctpGuest.join(scene));
    await pause(150);
  };
}

const malformed = Object.fromEntries(
  [...malformedChunks].map(([what, chunks]) => [what, withGuest((guest) => guest.chunks(...chunks))]),
);

const [BINARY, DCEP] = [53, 50];
const zeros = (length: number): number[] => new Array<number>(length).fill(0);
const bytes4 = (value: number) => [
  (value >>> 24) & 255,
  (value >> 16) & 255,
  (value >> 8) & 255,
  value & 255,
];

/** From an operator that has a session and misuses its data channels. */
export const sctpAttacks = attacks('sctp', {
  'three bytes': withGuest((guest) => guest.raw(Buffer.from([1, 2, 3]))),
  'wrong checksums and verification tags': withGuest(async (guest) => {
    await guest.raw(Buffer.alloc(16), Buffer.alloc(1100, 255), sctpPacket(1, ...dataChunk(1, 1)));
  }),
  ...malformed,
  'thousand random packets with valid checksums': withGuest(async (guest) => {
    const noise = new Noise(6);
    for (let n = 0; n < 1000; n++) {
      const type = [0, 1, 2, 3, 4, 5, 9, 10, 130, 192][noise.below(10)] as number;
      const body = [...noise.bytes(4 * noise.below(20))];
      await guest.chunks(type, noise.below(8), 0, 4 + body.length, ...body);
    }
  }),
  'a new association in the old one': withGuest((guest) =>
    guest.raw(sctpPacket(0, 1, 0, 0, 20, 0, 0, 0, 9, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0, 1)),
  ),
  ABORT: withGuest((guest) => guest.chunks(6, 0, 0, 4)),
  SHUTDOWN: withGuest((guest) => guest.chunks(7, 0, 0, 8, 0, 0, 0, 0)),
  'forged state cookie': withGuest((guest) => guest.chunks(10, 0, 0, 28, ...zeros(24))),
  'FORWARD TSN to the far end': withGuest((guest) =>
    guest.chunks(192, 0, 0, 12, ...bytes4(guest.association.localTsn + 2 ** 30), 0, 2, 255, 255),
  ),
  'acknowledges what was never sent': withGuest((guest) =>
    guest.chunks(3, 0, 0, 20, 127, 255, 255, 255, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 255, 255),
  ),
  'resets every stream': withGuest((guest) => {
    const streams = Array.from({ length: 400 }, (_, n) => [n >> 8, n & 255]).flat();
    const length = 16 + streams.length;
    const parameter = [
      0,
      13,
      length >> 8,
      length & 255,
      ...bytes4(1),
      ...bytes4(0),
      ...bytes4(0),
      ...streams,
    ];
    return guest.chunks(130, 0, (length + 4) >> 8, (length + 4) & 255, ...parameter);
  }),
  'message of 4 MB': withGuest(async (guest) => {
    guest.message(guest.operator.client.control.id, BINARY, Buffer.alloc(4 << 20));
    await inTime(
      guest.operator.until(({ type }) => type === 'session.closed'),
      'a message of 4 MB is accepted',
    );
  }),
  'unfinished messages on many streams': withGuest(async (guest) => {
    let tsn = guest.association.localTsn;
    for (let stream = 0; stream < 500; stream++) await guest.chunks(...dataChunk(tsn++, stream, 2));
  }),
  'thousands of fragments of one byte, with gaps': withGuest(async (guest) => {
    const first = guest.association.localTsn;
    for (let n = 0; n < 3000; n++) await guest.chunks(...dataChunk((first + 2 * n) >>> 0, 2, 0));
  }),
  'numbers far ahead': withGuest(async (guest) => {
    const first = guest.association.localTsn;
    for (let n = 0; n < 100; n++) await guest.chunks(...dataChunk((first + 10_000_000 * n) >>> 0, 2));
  }),
  'messages of unknown protocols': withGuest(async (guest) => {
    for (let protocol = 0; protocol < 60; protocol++) guest.message(2, protocol, Buffer.from('x'));
  }),
  'channel openings that lie about their lengths': withGuest(async (guest) => {
    for (let n = 0; n < 20; n++)
      guest.message(20 + n, DCEP, Buffer.from([3, 0, 0, 0, 0, 0, 0, 0, 255, 255, n, 9]));
    guest.message(41, DCEP, Buffer.from([2]));
    guest.message(42, DCEP, Buffer.from([3]));
  }),
  'opens channels without end': withGuest(async (guest) => {
    for (let n = 0; n < 300; n++) guest.operator.client.connection.createDataChannel(`channel ${n}`);
    await pause(500);
  }),
  'second channels with the names of the first': withGuest(async (guest) => {
    for (const name of ['session', 'control', 'telemetry', 'bandwidth', 'pictures', '__proto__']) {
      guest.operator.client.connection.createDataChannel(name);
    }
    await pause(300);
  }),
});
