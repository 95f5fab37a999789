/** Reliable channels on a path that loses packets, between a guarded peer and a plain werift peer. */
import { expect, it } from 'vitest';
import { useCleanups } from '../testing/cleanups.ts';
import { type LoopbackOptions, LoopbackPeers } from '../testing/loopback-peers.ts';

const cleanups = useCleanups();

async function open(options: LoopbackOptions): Promise<LoopbackPeers> {
  const peers = await LoopbackPeers.open(options);
  cleanups.push(() => peers.close());
  return peers;
}

it('brings every message of a reliable channel after an outage, whatever another channel gives up', async () => {
  let isAway = false;
  const peers = await open({
    onGuardedTransport: ({ iceTransport: { connection } }) => {
      const send = connection.send;
      connection.send = async (datagram) => (isAway ? undefined : send(datagram));
    },
  });
  const heard: string[] = [];
  peers.other.onDataChannel.subscribe((channel) => {
    channel.onMessage.subscribe((data) => heard.push(`${channel.label} ${data}`));
  });
  await peers.until(() => peers.connected);
  const reliable = peers.guarded.createDataChannel('reliable');
  const lossy = peers.guarded.createDataChannel('lossy', { ordered: false, maxRetransmits: 1 });
  await expect.poll(() => [reliable.readyState, lossy.readyState]).toEqual(['open', 'open']);
  isAway = true;
  for (let n = 0; n < 10; n++) {
    reliable.send(String(n));
    for (let k = 0; k < 5; k++) lossy.send(`${n}.${k}`.padEnd(k * 700, '-'));
  }
  // Until some of what may be lost has been given up.
  const association = lossy.sctp.sctp as unknown as { sentQueue: { abandoned: boolean }[] };
  await expect
    .poll(() => association.sentQueue.some(({ abandoned }) => abandoned), { timeout: 10_000 })
    .toBe(true);
  isAway = false;
  const arrived = () => heard.filter((text) => text.startsWith('reliable'));
  await expect.poll(() => arrived().length, { timeout: 10_000 }).toBe(10);
  expect(arrived()).toEqual(Array.from({ length: 10 }, (_, n) => `reliable ${n}`));
  lossy.send('again');
  await expect.poll(() => heard.at(-1), { timeout: 5000 }).toBe('lossy again');
});

it('hands over every message of an ordered channel that waited for an earlier one', async () => {
  let lost = 0;
  let loses = false;
  const peers = await open({
    onClientSocket: (socket) => {
      const send = socket.transport.send;
      // The first packet of a burst is lost, and sent again later.
      socket.transport.send = async (bytes) => {
        if (!loses || bytes[0] !== 23 || bytes.length < 100) return send(bytes);
        loses = false;
        lost++;
      };
    },
  });
  await peers.until(() => peers.connected);
  const loose = peers.other.createDataChannel('loose', { ordered: false });
  await peers.exchange('hello');
  await expect.poll(() => loose.readyState).toBe('open');
  loses = true;
  // Between two messages of the ordered channel, another channel takes a number.
  for (let n = 0; n < 4; n++) {
    peers.toGuarded.send(`ordered ${n}`.padEnd(200));
    loose.send(`loose ${n}`);
  }
  const ordered = () => peers.heard.filter((text) => text.startsWith('ordered')).map((text) => text.trim());
  await expect.poll(() => ordered().length, { timeout: 5000 }).toBe(4);
  expect(ordered()).toEqual(['ordered 0', 'ordered 1', 'ordered 2', 'ordered 3']);
  expect(lost).toBe(1);
});
