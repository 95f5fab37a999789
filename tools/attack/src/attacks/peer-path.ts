import { createSocket } from 'node:dgram';
import { once } from 'node:events';
import { isIPv6 } from 'node:net';
import { clientHello, dtlsRecord } from '@farpoint/webrtc/testing';
import type { Message } from 'werift';
import { stunMessage } from '../repeat/bytes.ts';
import { type Pattern, repeated } from '../repeat/repeated.ts';
import type { SctpGuest } from '../sctp-guest.ts';

const [REQUEST, INDICATION, SUCCESS, ERROR] = [0, 0x10, 0x100, 0x110];

/** A datagram from where the guest's path begins. */
const same =
  (datagram: (guest: SctpGuest) => Buffer): Pattern =>
  (guest) => {
    const bytes = datagram(guest);
    return () => guest.ice.send(bytes).catch(() => undefined);
  };

/** A connectivity check that the robot must answer. */
function check({ ice }: SctpGuest, change: (message: Message) => unknown = () => undefined): Buffer {
  const message = stunMessage(REQUEST, {
    USERNAME: `${ice.remoteUsername}:${ice.localUsername}`,
    PRIORITY: 0x7fffffff,
    'ICE-CONTROLLED': 1n,
  });
  change(message);
  return message.addMessageIntegrity(Buffer.from(ice.remotePassword)).bytes;
}

const unknown = (count: number) => (message: Message) => {
  for (let n = 0; n < count; n++) message.appendRawAttribute(0x7f00, Buffer.alloc(0));
};
/** Encrypted, but under no key. */
const forged = (contentType: number, length: number, sequence = 9) =>
  dtlsRecord(contentType, 1, 2 ** 40 + sequence, new Uint8Array(length));

/** Each STUN class and DTLS record kind, and what makes the most work of it. */
export const peerPathAttacks = repeated({
  'STUN: check': same((guest) => check(guest)),
  'STUN: nomination': same((guest) => check(guest, (message) => message.setAttribute('USE-CANDIDATE', null))),
  'STUN: check, always another': (guest) => () => guest.ice.send(check(guest)).catch(() => undefined),
  'STUN: role conflict': same((guest) =>
    check(guest, (message) => message.setAttribute('ICE-CONTROLLING', 2n ** 64n - 1n)),
  ),
  'STUN: check of 280 attributes': same((guest) => check(guest, unknown(280))),
  'STUN: check of 10,000 attributes': same((guest) => check(guest, unknown(10_000))),
  'STUN: checks from 250 addresses': async (guest, scene) => {
    const [host, port] = guest.ice.nominated?.remoteAddr ?? ['', 0];
    const sockets = Array.from({ length: 250 }, () => createSocket(isIPv6(host) ? 'udp6' : 'udp4').bind(0));
    await Promise.all(sockets.map((socket) => once(socket, 'listening')));
    scene.later(() => {
      for (const socket of sockets) socket.close();
    });
    return (n) => sockets[n % sockets.length]?.send(check(guest), port, host);
  },
  'STUN: indication': same(() => stunMessage(INDICATION).bytes),
  'STUN: answer to nobody': same(
    () => stunMessage(SUCCESS, { 'XOR-MAPPED-ADDRESS': ['192.0.2.1', 9] }).bytes,
  ),
  'STUN: error to nobody': same(() => stunMessage(ERROR, { 'ERROR-CODE': [487, 'Role Conflict'] }).bytes),
  'STUN: answer of 10,000 attributes': same(() => {
    const message = stunMessage(SUCCESS);
    unknown(10_000)(message);
    return message.bytes;
  }),
  'DTLS: data that is no SCTP': (guest) => () => guest.raw(Buffer.alloc(1)),
  'DTLS: 16 kB of data': (guest) => () => guest.raw(Buffer.alloc(16_000)),
  'DTLS: a hello in clear': same(() => clientHello()),
  'DTLS: change of ciphers': same(() => dtlsRecord(20, 0, 1, Uint8Array.of(1))),
  'DTLS: forged handshake': same(() => forged(22, 60)),
  'DTLS: forged alert': same(() => forged(21, 26)),
  'DTLS: forged data': same(() => forged(23, 1200)),
  'DTLS: 1,000 records in a datagram': same(() =>
    Buffer.concat(Array.from({ length: 1000 }, (_, n) => forged(23, 24, n))),
  ),
  'DTLS: records of a future epoch': same(() => dtlsRecord(23, 7, 1, new Uint8Array(100))),
});
