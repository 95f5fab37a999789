import { expect, test } from 'vitest';
import { BroadcastTransport } from './broadcast-transport.ts';

function collected(master: Uint8Array | null) {
  const transport = new BroadcastTransport(96, master);
  const sent: Buffer[] = [];
  transport.connect((pieces) => sent.push(Buffer.concat(pieces)));
  return { transport, sent };
}

test('numbers its packets, and says where a frame ends', () => {
  const { transport, sent } = collected(null);
  expect(transport.ready).toBe(true);
  transport.send(Uint8Array.of(1, 2), 0xffff_fff0, false);
  transport.send(Uint8Array.of(3), 0xffff_fff0, true);
  const [first, second] = sent as [Buffer, Buffer];
  expect(first.subarray(12)).toEqual(Buffer.of(1, 2));
  expect([first[0], first[1], second[1]]).toEqual([0x80, 96, 0x80 | 96]);
  expect(second.readUInt16BE(2) - first.readUInt16BE(2)).toBe(1);
  expect(first.readUInt32BE(4)).toBe(0xffff_fff0);
  expect(first.readUInt32BE(8)).toBe(transport.ssrc);
});

test('encrypts with a key, and never sends in clear then', () => {
  const { transport, sent } = collected(new Uint8Array(30).fill(5));
  transport.send(Buffer.from('a secret that is long enough'), 0, true);
  expect(sent[0]?.includes('secret')).toBe(false);
  expect(sent[0]?.length).toBe(12 + 28 + 10);
});

test('is another source after it was renewed', () => {
  const { transport, sent } = collected(new Uint8Array(30).fill(5));
  const ssrcs = new Set<number>();
  for (let i = 0; i < 50; i++) {
    transport.send(Uint8Array.of(0), 0, true);
    ssrcs.add(transport.ssrc);
    transport.renew();
  }
  expect(ssrcs.size).toBe(50);
  expect(new Set(sent.map((packet) => packet.toString('hex'))).size).toBe(50);
  expect(sent.every((packet) => packet.readUInt16BE(2) < 0x8000)).toBe(true);
});

test('drops everything while there is no relay', () => {
  const transport = new BroadcastTransport(96, null);
  expect(transport.ready).toBe(false);
  expect(transport.send(Uint8Array.of(1), 0, true)).toBe(null);
});

test('knocks with a packet that has nothing in it', () => {
  const { transport } = collected(null);
  const knock = transport.knock();
  expect(knock.length).toBe(12);
  expect(knock[0]).toBe(0x80);
});
