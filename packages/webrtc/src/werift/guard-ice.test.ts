/** Which connectivity checks of a peer that knows our password reach werift, at a stand-in for its ICE. */

import { beforeEach, expect, it } from 'vitest';
import type { RTCDtlsTransport } from 'werift';
import { PeerBudget, WATCHER_LIMITS } from '../peer-budget.ts';
import { Refusals } from '../refusal.ts';
import { connectivityCheck } from '../testing/hostile-datagrams.ts';
import { guardIce } from './guard-ice.ts';

type Address = [host: string, port: number];

const newCheck = () => connectivityCheck({ username: 'ours:theirs', password: 'our password' });

let ice: ReturnType<typeof standIn>;
let refusals: Refusals;
let receive: (datagram: Buffer, address: Address) => void;

function standIn() {
  return {
    userHistory: { ours: 'our password' },
    checkList: [] as { requestTransactionIds: Set<string>; remoteAddr: Address; protocol: object }[],
    remoteCandidates: [] as { host: string; port: number }[],
    earlyChecks: [] as object[],
    ensureProtocol: () => undefined,
  };
}

beforeEach(() => {
  [ice, refusals] = [standIn(), new Refusals()];
  guardIce({ iceTransport: { connection: ice } } as unknown as RTCDtlsTransport, refusals, new PeerBudget());
  const protocol = {
    // As werift does: each new address becomes a candidate.
    datagramReceived: (_: Buffer, [host, port]: Address) => {
      if (!ice.remoteCandidates.some((one) => one.port === port)) ice.remoteCandidates.push({ host, port });
    },
  };
  (ice.ensureProtocol as (protocol: object) => void)(protocol);
  receive = protocol.datagramReceived;
});

it('takes checks from as many addresses as a peer has, and goes on with those', () => {
  ice.remoteCandidates = Array.from({ length: 180 }, (_, port) => ({ host: 'h', port }));
  for (let port = 1000; port < 1020; port++) receive(newCheck(), ['h', port]);
  expect(ice.remoteCandidates).toHaveLength(192);
  expect(refusals.get('ice-too-many-sources')).toBe(8);
  receive(newCheck(), ['h', 5]);
  expect(refusals.get('ice-too-many-sources')).toBe(8);
});

it('keeps few checks while there are no candidates', () => {
  ice.earlyChecks = new Array<object>(64).fill({});
  receive(newCheck(), ['h', 1]);
  expect(refusals.get('ice-too-many-sources')).toBe(1);
});

it('answers as many checks as a peer sends, and no others count', () => {
  const forged = connectivityCheck({ username: 'ours:theirs', password: 'no password' });
  for (let n = 0; n < 1000; n++) receive(forged, ['h', 1]);
  expect(refusals.get('stun-rate-limited')).toBe(0);
  const { burst = 0 } = WATCHER_LIMITS.stun;
  for (let n = 0; n < burst + 500; n++) receive(newCheck(), ['h', 1]);
  // Some come back while this runs.
  expect(refusals.get('stun-rate-limited')).toBeGreaterThan(300);
});

it('lets werift remember few of the checks that came', () => {
  const requestTransactionIds = new Set(Array.from({ length: 256 }, (_, n) => String(n)));
  ice.checkList.push({ requestTransactionIds, remoteAddr: ['h', 1], protocol: {} });
  receive(newCheck(), ['h', 1]);
  expect(requestTransactionIds.size).toBe(0);
});

it('reads no message that is longer than checks and answers are', () => {
  const long = Buffer.alloc(1300, newCheck());
  receive(long, ['h', 1]);
  expect(refusals.get('stun-too-long')).toBe(1);
  expect(ice.remoteCandidates).toEqual([]);
});

it('takes a check that somebody repeats neither for the peer’s own nor from elsewhere', () => {
  const seen = newCheck();
  receive(seen, ['h', 1]);
  receive(seen, ['h', 2]);
  expect(refusals.get('stun-replayed')).toBe(1);
  expect(ice.remoteCandidates).toEqual([{ host: 'h', port: 1 }]);
  for (let n = 0; n < 1000; n++) receive(seen, ['h', 1]);
  const limited = refusals.get('stun-rate-limited');
  expect(limited).toBeGreaterThan(300);
  for (let n = 0; n < 100; n++) receive(newCheck(), ['h', 1]);
  expect(refusals.get('stun-rate-limited')).toBe(limited);
});
