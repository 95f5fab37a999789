import { sctpPacket } from '@farpoint/webrtc/testing';
import {
  bytes2,
  bytes4,
  chunk,
  data,
  FIRST,
  filled,
  LAST,
  MANY,
  opening,
  parameters,
  resets,
  sack,
  times,
  UNORDERED,
} from '../repeat/bytes.ts';
import { type Pattern, repeated } from '../repeat/repeated.ts';
import type { SctpGuest } from '../sctp-guest.ts';

/** The same chunks again and again. */
const same =
  (chunks: (guest: SctpGuest) => readonly number[]): Pattern =>
  (guest) => {
    const packet = guest.packet(...chunks(guest));
    return () => guest.raw(packet);
  };

/** Chunks whose numbers go on. @param first the robot has nothing from this number on */
const goingOn =
  (chunks: (tsn: number, n: number) => readonly number[]): Pattern =>
  (guest) => {
    const first = guest.association.localTsn;
    return (n) => guest.chunks(...chunks((first + n) >>> 0, n));
  };

/** What was set up last is less than this ahead. */
const SET_UP = 3000;
const streams = Array.from({ length: MANY }, (_, n) => n);
const init = [...bytes4(9), 0, 16, 0, 0, 255, 255, 255, 255, ...bytes4(1)];
/** A chunk type that is not ours, with a body. */
const foreign = (type: number) => same(() => chunk(type, filled(1000, 1)));

/** Each chunk type, and what makes the most work of it. */
export const peerSctpAttacks = repeated({
  'DATA: a repetition': same(({ association }) => data(association.localTsn + 2, 600)),
  'DATA: fills the gaps': goingOn((tsn) => data(tsn, 600)),
  'DATA: more gaps': (guest) => {
    const first = guest.association.localTsn + SET_UP;
    return (n) => guest.chunks(...data((first + 2 * (n % 500)) >>> 0, 600));
  },
  'DATA: fragments beside those that wait': (guest) => {
    const first = guest.association.localTsn + SET_UP;
    return (n) => guest.chunks(...data((first + (n % 400)) >>> 0, 601, UNORDERED));
  },
  'DATA: messages beside fragments that wait': (guest) => {
    const first = guest.association.localTsn + SET_UP;
    return (n) => guest.chunks(...data((first + n) >>> 0, 601));
  },
  'DATA: beginnings without an end, each stream in turn': (guest) => {
    const first = guest.association.localTsn + SET_UP;
    return (n) => guest.chunks(...data((first + n) >>> 0, 700 + (n % 50), FIRST));
  },
  'DATA: 55 repetitions in a packet': same(({ association: { localTsn } }) =>
    times(55, (n) => data(localTsn + 2 + 2 * n, 600)),
  ),
  'DATA: empty': same(({ association }) =>
    chunk(0, [...bytes4(association.localTsn), ...filled(8)], FIRST | LAST),
  ),
  'DATA: for a stream beyond all others': same(({ association }) =>
    data(association.localTsn + SET_UP, 65_535),
  ),
  'DATA: opens the same channel': goingOn((tsn) => opening(tsn, 800)),
  'DATA: opens another channel': goingOn((tsn, n) => opening(tsn, 800 + 2 * n)),
  'I-DATA': foreign(64),
  INIT: (guest) => {
    const packet = sctpPacket(0, ...chunk(1, [...init, ...parameters(30)]));
    return () => guest.raw(packet);
  },
  'INIT: 280 parameters': (guest) => {
    const packet = sctpPacket(0, ...chunk(1, [...init, ...parameters(MANY)]));
    return () => guest.raw(packet);
  },
  'INIT ACK': same(() => chunk(2, [...init, ...parameters(MANY)])),
  'SACK: a gap of 65,534': same(({ association }) => sack(association.lastReceivedTsn, [0, 2, 255, 255])),
  'SACK: 280 gaps': same(({ association }) =>
    sack(
      association.lastReceivedTsn,
      times(MANY, (n) => [...bytes2(200 * n + 2), ...bytes2(200 * n + 200)]),
    ),
  ),
  'SACK: 280 repetitions': same(({ association }) =>
    sack(association.lastReceivedTsn, [], filled(4 * MANY, 1)),
  ),
  'SACK: every second packet lost': same(({ association }) =>
    sack(
      association.lastReceivedTsn,
      times(MANY, (n) => [...bytes2(2 * n + 2), ...bytes2(2 * n + 2)]),
    ),
  ),
  'SACK: of what was never sent': same(({ association }) => sack(association.lastReceivedTsn + 2 ** 20, [])),
  'SACK: old': same(({ association }) => sack(association.lastReceivedTsn - 500, [0, 2, 255, 255])),
  HEARTBEAT: same(() => chunk(4, [0, 1, ...bytes2(1104), ...filled(1100, 9)])),
  'HEARTBEAT: 280 parameters': same(() => chunk(4, parameters(MANY))),
  'HEARTBEAT: 4,000 parameters': same(() => chunk(4, parameters(4000))),
  'HEARTBEAT: 50 in a packet': same(() => times(50, () => chunk(4, [0, 1, 0, 8, 1, 2, 3, 4]))),
  'HEARTBEAT ACK': same(() => chunk(5, [0, 1, ...bytes2(1104), ...filled(1100, 9)])),
  ABORT: same(() => chunk(6, parameters(MANY))),
  SHUTDOWN: same(() => chunk(7, filled(4))),
  'SHUTDOWN ACK': same(() => chunk(8, [])),
  'ERROR: 30 causes': same(() => chunk(9, parameters(30))),
  'ERROR: 280 causes': same(() => chunk(9, parameters(MANY))),
  'COOKIE ECHO': same(() => chunk(10, filled(24))),
  'COOKIE ECHO: 1,100 bytes': same(() => chunk(10, filled(1100))),
  'COOKIE ACK: 280 in a packet': same(() => times(MANY, () => chunk(11, []))),
  'ECNE and CWR': same(() => [...chunk(12, filled(4)), ...chunk(13, filled(4))]),
  'SHUTDOWN COMPLETE': same(() => chunk(14, [])),
  AUTH: foreign(15),
  'RE-CONFIG: resets 280 streams': same(() => chunk(130, resets(streams))),
  'RE-CONFIG: resets the streams that wait': same(() => chunk(130, resets(streams.map((n) => 600 + n)))),
  'RE-CONFIG: 50 parameters': same(() =>
    chunk(
      130,
      times(50, () => resets([9, 8])),
    ),
  ),
  'RE-CONFIG: adds 65,535 streams': same(() => chunk(130, [0, 17, 0, 12, ...filled(4), 255, 255, 0, 0])),
  'RE-CONFIG: answers': same(() => chunk(130, [0, 16, 0, 12, ...filled(4), ...bytes4(1)])),
  PAD: foreign(132),
  'FORWARD TSN: old': same(({ association }) => chunk(192, bytes4(association.localTsn - 1))),
  'FORWARD TSN: one stream 280 times': goingOn((tsn) =>
    chunk(192, [...bytes4(tsn), ...times(MANY, () => [...bytes2(601), 0, 1])]),
  ),
  'FORWARD TSN: each stream that waits': goingOn((tsn) =>
    chunk(192, [...bytes4(tsn), ...times(50, (n) => [...bytes2(700 + n), 0, 1])]),
  ),
  'FORWARD TSN: 280 streams, always others': goingOn((tsn, n) =>
    chunk(192, [...bytes4(tsn), ...times(MANY, (k) => [...bytes2(n * MANY + k), 0, 1])]),
  ),
  'FORWARD TSN: far ahead': goingOn((tsn, n) => chunk(192, bytes4(tsn + 5000 * n))),
  'I-FORWARD-TSN': foreign(194),
  ASCONF: foreign(193),
  'an unknown chunk': foreign(77),
});
