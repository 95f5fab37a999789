import { loadAddon } from '@farpoint/udp-batch';
import { expect, it } from 'vitest';
import type { RTCDtlsTransport } from 'werift';
import { useCleanups } from '../testing/cleanups.ts';
import { LoopbackPeers } from '../testing/loopback-peers.ts';
import { datagramsSent } from './datagram-batches.ts';
import { IcePath } from './ice-path.ts';

/** Neither STUN nor DTLS nor RTP (RFC 7983): only this test hears it. */
const OTHERS = 0xff;

const cleanups = useCleanups();

it('sends the parts as one datagram each on the selected pair, in order, in batches where there is the addon', async () => {
  const peers = await LoopbackPeers.open();
  cleanups.push(() => peers.close());
  await peers.until(() => peers.connected);
  const heard: string[] = [];
  const all = Promise.withResolvers<void>();
  peers.other.iceTransports[0]?.connection.onData.subscribe((datagram) => {
    if (datagram[0] !== OTHERS) return;
    heard.push(datagram.subarray(1).toString());
    if (heard.length === 100) all.resolve();
  });
  // Two streams of one session.
  const paths = [0, 1].map(() => new IcePath(peers.guarded.dtlsTransports[0] as RTCDtlsTransport));
  expect(paths.map((path) => path.refresh())).toEqual([true, true]);
  const before = { ...datagramsSent };
  for (let n = 0; n < 100; n++) paths[n % 2]?.send([Buffer.of(OTHERS), Buffer.from(`${n}`)]);
  await all.promise;
  expect(heard).toEqual(Array.from({ length: 100 }, (_, n) => String(n)));
  const batched = loadAddon() === null ? 0 : 100;
  expect(datagramsSent.batched - before.batched).toBe(batched);
  expect(datagramsSent.single - before.single).toBe(100 - batched);
  expect(datagramsSent.failed).toBe(before.failed);
});

it('counts what is sent after the connection has closed, and throws nothing', async () => {
  const peers = await LoopbackPeers.open();
  cleanups.push(() => peers.close());
  await peers.until(() => peers.connected);
  const path = new IcePath(peers.guarded.dtlsTransports[0] as RTCDtlsTransport);
  expect(path.refresh()).toBe(true);
  const before = datagramsSent.failed;
  path.send([Buffer.of(OTHERS)]);
  const closed = peers.guarded.close();
  path.send([Buffer.of(OTHERS)]);
  await closed;
  path.send([Buffer.of(OTHERS)]);
  await new Promise((resolve) => setImmediate(resolve));
  expect(datagramsSent.failed - before).toBeGreaterThan(0);
  expect(path.refresh()).toBe(false);
});
