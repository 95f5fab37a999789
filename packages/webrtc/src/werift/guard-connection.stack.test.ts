import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { describe, expect, it } from 'vitest';
import { createSelfSignedCertificate, RTCPeerConnection } from 'werift';
import { finishedData } from '../dtls/peer-proof.ts';
import { parseRecords } from '../dtls/record.ts';
import { stunKind } from '../stun/binding-request.ts';
import { useCleanups } from '../testing/cleanups.ts';
import { dtlsRecord } from '../testing/dtls-record.ts';
import {
  clientHello,
  closeAlert,
  connectivityCheck,
  fatalAlert,
  malformedChunks,
  sctpPacket,
} from '../testing/hostile-datagrams.ts';
import { type LoopbackOptions, LoopbackPeers } from '../testing/loopback-peers.ts';
import { guardConnection } from './guard-connection.ts';
import { WeriftShapeError } from './werift-shape.ts';

const cleanups = useCleanups();

async function open(options: LoopbackOptions = {}): Promise<LoopbackPeers> {
  const peers = await LoopbackPeers.open(options);
  cleanups.push(() => peers.close());
  return peers;
}

async function connect(options: LoopbackOptions = {}): Promise<LoopbackPeers> {
  const peers = await open(options);
  await peers.until(() => peers.connected);
  await peers.exchange('hello');
  return peers;
}

/** Replaces the described fingerprint, whatever the first byte of the real one is. */
function withAnotherFingerprint(sdp: string): string {
  return sdp.replaceAll(/(?<=fingerprint:sha-256 )../g, (byte) =>
    byte.toUpperCase() === 'FF' ? '00' : 'FF',
  );
}

/** A certificate with the key of another one. */
async function stolenCertificate() {
  const signatureHash = { hash: 4, signature: 3 } as const;
  const [victim, thief] = await Promise.all([0, 0].map(() => createSelfSignedCertificate(signatureHash)));
  return { certPem: victim?.certPem ?? '', keyPem: thief?.keyPem ?? '', signatureHash };
}

function plainRecord(contentType: number, fragment: readonly number[], epoch = 0): Buffer {
  return dtlsRecord(contentType, epoch, 256, Uint8Array.from(fragment));
}

for (const guardedAnswers of [false, true]) {
  describe(`a guarded connection that ${guardedAnswers ? 'answers' : 'offers'}`, () => {
    it('connects with the described peer, and refuses nothing from it', async () => {
      const peers = await connect({ guardedAnswers });
      expect([...peers.refusals.entries()]).toEqual([]);
    });

    it('fails if the peer does not hold the key of its certificate', async () => {
      const peers = await open({ guardedAnswers, keys: await stolenCertificate() });
      await peers.until(() => peers.unproven !== null);
      expect(peers.unproven?.reason).toBe(guardedAnswers ? 'bad-key-exchange' : 'bad-certificate-verify');
      await peers.until(() => peers.guarded.connectionState === 'failed');
      expect(peers.heard).toEqual([]);
    });
  });
}

describe('the handshake', () => {
  it('fails if the certificate is not the described one', async () => {
    const peers = await open({ onAnswer: withAnotherFingerprint });
    await peers.until(() => peers.unproven !== null);
    expect(peers.unproven?.reason).toBe('fingerprint-mismatch');
    await peers.until(() => peers.guarded.connectionState === 'failed');
    expect(peers.heard).toEqual([]);
  });

  it('fails if Finished does not prove that both saw the same handshake', async () => {
    const peers = await open({
      onClientSocket: (socket) => {
        Object.assign(socket.cipher, {
          verifyData: () => finishedData(Buffer.alloc(1), Buffer.alloc(48), 'client'),
        });
      },
    });
    await peers.until(() => peers.unproven !== null);
    expect(peers.unproven?.reason).toBe('bad-finished');
  });

  it('accepts a hello that arrived before the transport was ready, without a second one', async () => {
    let hellos = 0;
    const greeted = Promise.withResolvers<void>();
    const peers = await open({
      onGuardedTransport: (transport) => {
        // As with a slow check of ours: the peer's own check has already succeeded.
        const start = transport.start.bind(transport);
        transport.start = async () => {
          await greeted.promise;
          await start();
        };
        transport.iceTransport.connection.onData.subscribe((datagram) => {
          if (datagram[13] === 1) greeted.resolve();
        });
      },
      onClientSocket: (socket) => {
        const send = socket.transport.send;
        socket.transport.send = (bytes) => {
          if (bytes[0] === 22 && bytes[13] === 1) hellos++;
          return send(bytes);
        };
      },
    });
    await peers.until(() => peers.connected);
    // One without a cookie, one with.
    expect(hellos).toBe(2);
    await peers.exchange('hello');
  });

  it('never encrypts two records with one nonce', async () => {
    const sequences: number[] = [];
    const peers = await open({
      onGuardedTransport: (transport) => {
        const { connection } = transport.iceTransport;
        const send = connection.send;
        connection.send = (datagram) => {
          for (const { epoch, sequence } of parseRecords(datagram).records) {
            if (epoch === 1) sequences.push(sequence);
          }
          return send(datagram);
        };
      },
    });
    await peers.until(() => peers.connected);
    for (let n = 0; n < 12; n++) await peers.exchange(`message ${n}`);
    expect(sequences.length).toBeGreaterThan(12);
    expect(new Set(sequences).size).toBe(sequences.length);
  });

  it('survives flights that are lost, duplicated and reordered', async () => {
    let sent = 0;
    const peers = await open({
      onClientSocket: (socket) => {
        const send = socket.transport.send;
        const held: Buffer[] = [];
        socket.transport.send = async (bytes) => {
          // The first copy of the last flight arrives in the wrong order, and twice.
          if (bytes[0] === 22 && bytes[13] !== 1 && sent < 5) held.push(bytes);
          else if (held.length === 0) return send(bytes);
          else held.push(bytes);
          if (++sent !== 5) return;
          for (const late of held.splice(0).reverse()) {
            await send(late);
            await send(late);
          }
        };
      },
    });
    await peers.until(() => peers.connected);
    await peers.exchange('hello');
  });
});

describe('a running session', () => {
  it('plaintext from the peer’s own address does not end it', async () => {
    const peers = await connect();
    for (const datagram of [closeAlert, fatalAlert, clientHello(), plainRecord(23, [1, 2, 3])]) {
      await peers.inject(datagram);
    }
    await peers.until(() => peers.refusals.get('dtls-plaintext') === 4);
    await peers.exchange('still here');
    expect(peers.connected).toBe(true);
  });

  it('plaintext that claims to be encrypted does not end it', async () => {
    const peers = await connect();
    await peers.inject(plainRecord(21, [1, 0], 1));
    await peers.inject(plainRecord(21, new Array(40).fill(0), 1));
    await peers.inject(plainRecord(23, new Array(40).fill(0), 2));
    await peers.until(() => peers.refusals.get('dtls-epoch') === 1);
    expect(peers.refusals.get('dtls-unauthentic')).toBe(2);
    await peers.exchange('still here');
  });

  it('hears nothing from a stranger: no alert, no hello, no unauthenticated connectivity check', async () => {
    const peers = await connect();
    const [host, port] = peers.guardedAddress;
    const stranger = createSocket('udp4').bind(0);
    cleanups.push(() => stranger.close());
    await once(stranger, 'listening');
    const answers: Buffer[] = [];
    stranger.on('message', (datagram) => answers.push(datagram));
    const username = `${peers.guarded.iceTransports[0]?.connection.localUsername}:x`;
    const check = connectivityCheck({ username });
    for (const datagram of [closeAlert, clientHello(), check]) stranger.send(datagram, port, host);
    await peers.until(() => peers.refusals.get('stun-unauthenticated') === 1);
    await peers.until(() => peers.refusals.get('unknown-source') === 2);
    await peers.exchange('still here');
    // Only the request authenticated with the session's password is answered: an answer to the others would have come
    // first.
    const { localPassword } = peers.guarded.iceTransports[0]?.connection ?? { localPassword: '' };
    const sealed = connectivityCheck({ username, password: localPassword, nominate: false });
    stranger.send(sealed, port, host);
    await once(stranger, 'message');
    expect(answers[0]?.subarray(8, 20)).toEqual(sealed.subarray(8, 20));
    expect(stunKind(answers[0] as Buffer)).toBe('response');
  });

  it('accepts a record once', async () => {
    const records: Buffer[] = [];
    const peers = await connect({
      onClientSocket: (socket) => {
        const send = socket.transport.send;
        socket.transport.send = (bytes) => {
          if (bytes[0] === 23) records.push(Buffer.from(bytes));
          return send(bytes);
        };
      },
    });
    const count = records.length;
    for (const record of records.slice()) await peers.inject(record);
    await peers.until(() => peers.refusals.get('dtls-replayed') === count);
    await peers.exchange('still here');
    expect(peers.heard).toEqual(['hello', 'still here']);
  });

  it('ends when the peer closes it under its keys', async () => {
    const peers = await connect();
    const sealed = (
      peers.socket.cipher as unknown as { encryptPacket(packet: unknown): { serialize(): Buffer } }
    ).encryptPacket({
      recordLayerHeader: {
        contentType: 21,
        protocolVersion: { major: 0xfe, minor: 0xfd },
        epoch: 1,
        sequenceNumber: 1000,
        contentLen: 2,
      },
      fragment: Buffer.from([1, 0]),
      serialize(this: { recordLayerHeader: { contentLen: number }; fragment: Buffer }) {
        const header = Buffer.from([21, 0xfe, 0xfd, 0, 1, 0, 0, 0, 0, 0x03, 0xe8, 0, this.fragment.length]);
        return Buffer.concat([header, this.fragment]);
      },
    });
    const closed = new Promise((resolve) =>
      peers.guarded.dtlsTransports[0]?.onStateChange.subscribe(
        (state) => state === 'closed' && resolve(state),
      ),
    );
    await peers.inject(sealed.serialize());
    expect(await closed).toBe('closed');
  });

  it('survives malformed SCTP and invalid messages from a peer that has the keys', async () => {
    const peers = await connect();
    const transport = peers.other.dtlsTransports[0];
    const association = peers.guarded.sctpTransport?.sctp as unknown as { localVerificationTag: number };
    const packet = (...chunks: readonly number[]) => sctpPacket(association.localVerificationTag, ...chunks);
    await transport?.sendData(Buffer.from([1, 2, 3]));
    for (const chunks of malformedChunks.values()) await transport?.sendData(packet(...chunks));
    // Two INIT chunks in one packet are well framed, but nothing begins an association that is established.
    await peers.until(() => peers.refusals.get('sctp-malformed') === malformedChunks.size);
    await transport?.sendData(packet(4, 0, 0, 8, 0, 1, 0, 4).fill(0, 8, 12));
    await peers.until(() => peers.refusals.get('sctp-failed') === 1);
    expect(peers.refusals.get('sctp-out-of-order')).toBe(1);
    const { sctp } = peers.other.sctpTransport ?? {};
    await sctp?.send(40, 50, Buffer.from([2]));
    await sctp?.send(41, 50, Buffer.from([3, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0]));
    await sctp?.send(42, 99, Buffer.from('strange'));
    await peers.until(() => peers.refusals.get('message-malformed') === 3);
    await peers.exchange('still here');
  });

  it('refuses a message of 4 MB after its first 64 KiB, without assembling it', async () => {
    const peers = await connect();
    const { sctp } = peers.guarded.sctpTransport as unknown as { sctp: { inboundStreams: object } };
    // The channel itself would refuse to send it.
    void peers.other.sctpTransport?.sctp.send(peers.toGuarded.id, 53, Buffer.alloc(4 << 20));
    await peers.until(() => peers.faults.length === 1);
    expect(peers.faults).toMatchObject([{ name: 'ExcessError', message: 'message-too-large' }]);
    expect(peers.refusals.get('message-too-large')).toBe(1);
    expect(sctp.inboundStreams).toEqual({});
    expect(peers.heard).toEqual(['hello']);
  });

  it('reports a listener that throws, and keeps working', async () => {
    const peers = await connect();
    peers.onHeard = () => {
      throw new Error('a fault of ours');
    };
    peers.toGuarded.send('anything');
    await peers.until(() => peers.faults.length === 1);
    peers.onHeard = null;
    await peers.exchange('still here');
  });

  it('announces an unordered channel with a lifetime as RFC 8832 requires', async () => {
    const peers = await connect();
    const opened = new Promise<boolean>((resolve) =>
      peers.other.onDataChannel.subscribe((channel) => {
        if (channel.label === 'loose') resolve(channel.ordered);
      }),
    );
    peers.guarded.createDataChannel('loose', { ordered: false, maxPacketLifeTime: 100 });
    expect(await opened).toBe(false);
  });
});

describe('guardConnection', () => {
  it('refuses a connection that is already under way', () => {
    const connection = new RTCPeerConnection({ iceServers: [] });
    cleanups.push(() => connection.close());
    connection.createDataChannel('early');
    expect(() => guardConnection(connection)).toThrow(WeriftShapeError);
  });
});
