/** What a peer that has the keys may make a real association do. */
import { expect, it } from 'vitest';
import { DRIVER_LIMITS, WATCHER_LIMITS } from '../peer-budget.ts';
import { MAX_OPENINGS } from '../sctp/receive-bound.ts';
import { useCleanups } from '../testing/cleanups.ts';
import { dataChunk, sctpPacket } from '../testing/hostile-datagrams.ts';
import { LoopbackPeers } from '../testing/loopback-peers.ts';

const cleanups = useCleanups();

interface Association {
  localVerificationTag: number;
  lastReceivedTsn: number;
  lastSackedTsn: number;
  inboundStreams: Record<number, unknown>;
  sackMisOrdered: Set<number>;
  handleData(packet: Buffer): Promise<void>;
}

const bytes2 = (value: number) => [(value >> 8) & 255, value & 255];
const bytes4 = (value: number) => [...bytes2(value >>> 16), ...bytes2(value)];

function chunk(type: number, body: readonly number[]): number[] {
  return [type, 0, ...bytes2(body.length + 4), ...body];
}

/** A guarded peer, and what hands a packet of the other one to its association. */
async function connect(drives = false) {
  const peers = await LoopbackPeers.open({ drives: () => drives });
  cleanups.push(() => peers.close());
  await peers.exchange('hello');
  const sctp = peers.guarded.sctpTransport?.sctp as unknown as Association;
  // Nothing of the other's own comes between.
  const handleData = sctp.handleData.bind(sctp);
  sctp.handleData = async () => undefined;
  const receive = (...chunks: readonly number[]) =>
    handleData(sctpPacket(sctp.localVerificationTag, ...chunks));
  return { peers, sctp, receive };
}

it.each([
  ['watches', false, WATCHER_LIMITS],
  ['drives', true, DRIVER_LIMITS],
] as const)(
  'takes as many chunks from a peer that %s as its budget has',
  async (_, drives, { sctp: limit }) => {
    const { peers, receive } = await connect(drives);
    const burst = limit.burst ?? 0;
    const cookieAck = chunk(11, []);
    // In packets of a hundred.
    for (let n = 0; n < burst / 100 - 1; n++) await receive(...new Array(100).fill(cookieAck).flat());
    expect(peers.refusals.get('sctp-rate-limited')).toBe(0);
    for (let n = 0; n < 4 * (burst / 100); n++) await receive(...new Array(100).fill(cookieAck).flat());
    expect(peers.refusals.get('sctp-rate-limited')).toBeGreaterThan(burst / 100);
  },
);

it('ends with a peer whose FORWARD TSN names more streams than there may be', async () => {
  const { peers, sctp, receive } = await connect();
  const streams = Array.from({ length: 100 }, (_, n) => [...bytes2(n + 10), 0, 1]).flat();
  await receive(...chunk(192, [...bytes4(sctp.lastReceivedTsn + 1), ...streams]));
  expect(peers.refusals.get('sctp-overfull')).toBe(1);
  expect(peers.faults).toMatchObject([{ name: 'ExcessError', message: 'sctp-overfull' }]);
  expect(sctp.inboundStreams).toEqual({});
});

it('keeps of numbers behind gaps what they need, and hands over what arrives behind them', async () => {
  const { peers, sctp, receive } = await connect();
  const { lastReceivedTsn } = sctp;
  for (let n = 0; n < 500; n++) await receive(...dataChunk((lastReceivedTsn + 2 + 2 * n) >>> 0, 9, 7));
  expect(sctp.sackMisOrdered.size).toBe(0);
  expect(sctp.lastReceivedTsn).toBe(lastReceivedTsn);
  for (let n = 0; n < 500; n++) await receive(...dataChunk((lastReceivedTsn + 1 + 2 * n) >>> 0, 9, 7));
  expect(sctp.lastReceivedTsn).toBe((lastReceivedTsn + 1000) >>> 0);
  expect([...peers.refusals.entries()]).toEqual([]);
});

it('believes no acknowledgement of what was never sent, and no new association', async () => {
  const { peers, sctp, receive } = await connect();
  const { lastSackedTsn, lastReceivedTsn } = sctp;
  await receive(...chunk(3, [...bytes4(lastSackedTsn + 9), 0, 1, 0, 0, 0, 0, 0, 0]));
  expect(peers.refusals.get('sctp-false-ack')).toBe(1);
  expect(sctp.lastSackedTsn).toBe(lastSackedTsn);
  await receive(...chunk(2, [...bytes4(9), 0, 1, 0, 0, 0, 9, 0, 9, ...bytes4(7)]));
  expect(peers.refusals.get('sctp-out-of-order')).toBe(1);
  expect(sctp.lastReceivedTsn).toBe(lastReceivedTsn);
});

it('ends with a peer that opens channel after channel, though it closes them', async () => {
  const { peers, sctp, receive } = await connect();
  for (let n = 0; n <= MAX_OPENINGS; n++) {
    const tsn = (sctp.lastReceivedTsn + 1) >>> 0;
    const opening = [...bytes4(tsn), 0, 21, ...bytes2(0), 0, 0, 0, 50, 3, ...new Array(11).fill(0)];
    await receive(0, 3, ...bytes2(opening.length + 4), ...opening);
    // Closes the stream.
    await receive(...chunk(130, [0, 13, 0, 18, ...bytes4(n), ...bytes4(0), ...bytes4(tsn), 0, 21, 0, 0]));
  }
  expect(peers.faults).toMatchObject([{ name: 'ExcessError', message: 'too-many-channels' }]);
  expect(peers.refusals.get('too-many-channels')).toBe(1);
});
