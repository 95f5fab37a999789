import { KeyObject } from 'node:crypto';
import { afterEach, expect, it } from 'vitest';
import type { RTCDtlsTransport } from 'werift';
import { LoopbackPeers } from '../testing/loopback-peers.ts';
import { useKeyObjects } from './key-objects.ts';
import { WeriftShapeError } from './werift-shape.ts';

let peers: LoopbackPeers | null = null;
afterEach(() => peers?.close());

it('gives every cipher of a guarded connection its keys as objects, and the connection still works', async () => {
  peers = await LoopbackPeers.open({});
  await peers.until(() => peers?.connected === true);
  const [transport] = peers.guarded.dtlsTransports;
  const { cipher } = (transport as unknown as { dtls: { cipher: { cipher: Record<string, unknown> } } }).dtls
    .cipher;
  expect(cipher.clientWriteKey).toBeInstanceOf(KeyObject);
  expect(cipher.serverWriteKey).toBeInstanceOf(KeyObject);
  const srtcp = transport?.srtcp as unknown as
    | { remoteContext: { cipher: Record<string, unknown> } }
    | undefined;
  if (srtcp !== undefined) expect(srtcp.remoteContext.cipher.srtcpSessionKey).toBeInstanceOf(KeyObject);
  await peers.exchange('sealed with them');
});

it('throws if werift’s internals differ', () => {
  expect(() => useKeyObjects({} as RTCDtlsTransport)).toThrow(WeriftShapeError);
});
