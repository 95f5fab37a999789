import {
  clientHello,
  closeAlert,
  connectivityCheck,
  dtlsRecord,
  handshakeRecord,
  noiseRtcp,
  noiseRtp,
  sctpPacket,
  strayResponse,
} from '@farpoint/webrtc/testing';
import { Noise } from './noise.ts';

export interface FloodKind {
  name: string;
  /** Sent in turn. @param username of the attacked session's connectivity checks */
  datagrams: (username: string) => readonly Uint8Array[];
}

const many = (make: (n: number) => Uint8Array) => Array.from({ length: 256 }, (_, n) => make(n));

export const floodKinds: readonly FloodKind[] = [
  { name: 'plaintext alerts', datagrams: () => [closeAlert] },
  { name: 'ClientHellos', datagrams: () => many((n) => clientHello(n, n)) },
  {
    name: 'handshake messages',
    datagrams: () =>
      many((n) => handshakeRecord([11, 16, 15, 20][n % 4] as number, new Array(200).fill(n), n)),
  },
  {
    name: 'forged encrypted records',
    datagrams: () => many((n) => dtlsRecord(23, 1, 1_000_000 + n, new Noise(n).bytes(200))),
  },
  { name: 'checks without integrity', datagrams: (username) => [connectivityCheck({ username })] },
  {
    name: 'checks with a wrong password',
    datagrams: (username) => many((n) => connectivityCheck({ username, password: `password ${n}` })),
  },
  { name: 'STUN responses', datagrams: () => many(() => strayResponse()) },
  { name: 'forged RTP, 1,200 bytes', datagrams: () => many((n) => noiseRtp(111, 1, n, 1200)) },
  { name: 'forged RTCP', datagrams: () => many((n) => noiseRtcp(200 + (n % 8), n % 32)) },
  {
    name: 'SCTP without DTLS',
    datagrams: () => many((n) => sctpPacket(n, 0, 3, 0, 16, ...new Array(12).fill(n))),
  },
  { name: 'random bytes', datagrams: () => many((n) => new Noise(n).bytes(1 + ((n * 5) % 1200))) },
];
