import { describe, expect, it } from 'vitest';
import { RTCPeerConnection } from 'werift';
import { useCleanups } from '../testing/cleanups.ts';
import { addresses, error, HostileTurn, lifetime, success, TURN } from '../testing/hostile-turn.ts';
import { guardConnection } from './guard-connection.ts';

const cleanups = useCleanups();

type Answer = (request: Buffer, method: number) => readonly Buffer[];

/** A guarded connection that gathers its candidates through the server. */
async function gather(answer: Answer): Promise<{ turn: HostileTurn; relays: string[]; hosts: string[] }> {
  const turn = await HostileTurn.open(answer);
  cleanups.push(() => turn.close());
  const connection = new RTCPeerConnection({
    iceServers: [{ urls: `turn:127.0.0.1:${turn.port}`, username: 'u', credential: 'p' }],
    iceUseIpv6: false,
  });
  cleanups.push(() => connection.close());
  guardConnection(connection);
  connection.createDataChannel('x');
  await connection.setLocalDescription(await connection.createOffer());
  const lines = connection.localDescription?.sdp.split('\r\n') ?? [];
  const of = (type: string) => lines.filter((line) => line.includes(`typ ${type}`));
  return { turn, relays: of('relay'), hosts: of('host') };
}

const bytes = (length: number, value: number) => Buffer.alloc(length, value);

describe('a TURN server that lies', () => {
  it('gives a relay if it tells the truth', async () => {
    const { relays } = await gather((request) => [success(request, lifetime(600), ...addresses(4242))]);
    expect(relays).toHaveLength(1);
  });

  it.each<[string, Answer]>([
    ['no address', (request) => [success(request, lifetime(600))]],
    [
      'an address of another family',
      (request) => [success(request, [0x0016, bytes(8, 9)], [0x0020, bytes(8, 9)])],
    ],
    ['an address cut short', (request) => [success(request, [0x0016, bytes(3, 1)], [0x0020, bytes(0, 0)])]],
    ['an error without a code', (request) => [error(request)]],
    ['an error whose code is cut short', (request) => [error(request, [0x0009, bytes(1, 4)])]],
    [
      'unauthorised, for ever',
      (request) => [
        error(request, [0x0009, Buffer.from([0, 0, 4, 1])], [0x0014, bytes(3, 97)], [0x0015, bytes(3, 98)]),
      ],
    ],
    ['attributes beyond the message', (request) => [success(request, [0x0016, bytes(8, 1)]).subarray(0, 26)]],
    ['a lifetime of one byte', (request) => [success(request, [0x000d, bytes(1, 1)], ...addresses(4242))]],
    ['rubbish', () => [bytes(1, 0), bytes(20, 0), bytes(1200, 0x40), bytes(4, 0x7f), bytes(0, 0)]],
  ])('%s: the connection goes on without a relay, and nothing throws', async (_, answer) => {
    const { turn, relays, hosts } = await gather((request, method) => [
      ...answer(request, method),
      // Whatever it was, an end of the wait.
      error(request, [0x0009, Buffer.from([0, 0, 4, 3])]),
    ]);
    expect(relays).toEqual([]);
    expect(hosts.length).toBeGreaterThan(0);
    // Werift sends a request again seven times at most.
    expect(turn.count(TURN.allocate)).toBeLessThanOrEqual(8);
  });

  it('data from nobody: indications, channels that are not bound, requests of a stranger', async () => {
    const data: Buffer[] = [];
    const { relays } = await gather((request) => {
      const indication = success(request, [0x0013, bytes(40, 22)], [0x0012, bytes(8, 1)]);
      indication.writeUInt16BE(0x0017, 0);
      data.push(indication);
      return [
        success(request, lifetime(600), ...addresses(4242)),
        indication,
        Buffer.concat([Buffer.from([0x40, 0, 0, 20]), bytes(20, 20)]),
        Buffer.concat([Buffer.from([0x40, 0, 0xff, 0xff]), bytes(20, 20)]),
      ];
    });
    expect([relays.length, data.length > 0]).toEqual([1, true]);
  });

  it('a lifetime of 0 s: it is not asked again without a pause (any other: guard-relay.test.ts)', async () => {
    const { turn } = await gather((request) => [success(request, lifetime(0), ...addresses(4242))]);
    await turn.asked(TURN.allocate);
    // Without a pause, a refresh would come between two of them.
    for (let i = 0; i < 50; i++) await turn.roundTrip();
    expect(turn.count(TURN.refresh)).toBe(0);
  });
});
