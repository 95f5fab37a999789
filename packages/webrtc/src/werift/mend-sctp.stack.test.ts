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
  await expect.poll(() => heard, { timeout: 5000 }).toContain('lossy again');
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

/** What the guarded peer's association says about its sending. */
interface Sender {
  sentQueue: { acked: boolean; sentCount: number; abandoned: boolean }[];
  outboundQueue: unknown[];
  forwardTsnChunk: unknown;
  advancedPeerAckTsn: number;
  sendChunk(chunk: { type: number }): Promise<void>;
}

const [DATA, FORWARD_TSN] = [0, 192];

/** A guarded peer with a channel that may lose messages, and what decides which of its chunks are lost. */
async function lossy(limit: { maxRetransmits: number } | { maxPacketLifeTime: number }) {
  const peers = await open({});
  const heard: string[] = [];
  peers.other.onDataChannel.subscribe((channel) => {
    channel.onMessage.subscribe((data) => heard.push(`${channel.label} ${data}`));
  });
  await peers.until(() => peers.connected);
  const channel = peers.guarded.createDataChannel('lossy', { ordered: false, ...limit });
  const reliable = peers.guarded.createDataChannel('reliable');
  await expect.poll(() => [channel.readyState, reliable.readyState]).toEqual(['open', 'open']);
  const sender = channel.sctp.sctp as unknown as Sender;
  await expect.poll(() => sender.sentQueue.length).toBe(0);
  const sent: number[] = [];
  const state = { loses: (_: number) => false };
  const sendChunk = sender.sendChunk.bind(sender);
  sender.sendChunk = async (chunk) => {
    sent.push(chunk.type);
    if (!state.loses(chunk.type)) await sendChunk(chunk);
  };
  return { channel, reliable, sender, sent, heard, state };
}

it.each([
  ['without retransmissions', { maxRetransmits: 0 }],
  ['whose time is over', { maxPacketLifeTime: 100 }],
])('gives up a lost message %s, and says so until the peer knows', async (_, limit) => {
  const { channel, reliable, sender, sent, heard, state } = await lossy(limit);
  let losses = 0;
  // The first message, and the first word about it.
  state.loses = (type) =>
    type === DATA ? losses === 0 && ++losses === 1 : type === FORWARD_TSN && ++losses === 2;
  channel.send('lost');
  reliable.send('one');
  await expect.poll(() => losses, { timeout: 10_000 }).toBe(2);
  await expect.poll(() => sender.sentQueue.length, { timeout: 10_000 }).toBe(0);
  expect(sent.filter((type) => type === FORWARD_TSN).length).toBeGreaterThan(1);
  channel.send('next');
  await expect.poll(() => heard, { timeout: 5000 }).toEqual(['reliable one', 'lossy next']);
});

it('sends nothing that has become too old while it waited, and nothing is missed', async () => {
  const { channel, reliable, sender, heard, state } = await lossy({ maxPacketLifeTime: 1 });
  // Nothing gets out: what is sent fills the window, and the rest waits.
  state.loses = () => true;
  for (let n = 0; n < 20; n++) reliable.send(`${n}`.padEnd(1000));
  await expect.poll(() => sender.outboundQueue.length).toBeGreaterThan(5);
  for (let n = 0; n < 20; n++) channel.send(`old ${n}`);
  state.loses = () => false;
  await expect.poll(() => heard.length, { timeout: 20_000 }).toBe(20);
  channel.send('new');
  await expect.poll(() => heard, { timeout: 5000 }).toContain('lossy new');
  expect(heard.filter((text) => text.startsWith('lossy'))).toEqual(['lossy new']);
  await expect.poll(() => sender.sentQueue.length, { timeout: 5000 }).toBe(0);
}, 40_000);

it('does not send again what has arrived behind a gap', async () => {
  const { reliable, sender, heard, state } = await lossy({ maxRetransmits: 0 });
  let data = 0;
  // The first is lost, also when it is sent again; two follow, too few to be a sign of its loss.
  state.loses = (type) => type === DATA && [1, 4].includes(++data);
  for (const text of ['a', 'b', 'c']) reliable.send(text);
  await expect.poll(() => heard, { timeout: 10_000 }).toEqual(['reliable a', 'reliable b', 'reliable c']);
  await expect.poll(() => sender.sentQueue.length).toBe(0);
  expect(data).toBe(5);
});
