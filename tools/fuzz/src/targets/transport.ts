import {
  CandidateGate,
  compoundWork,
  type DtlsEndpoint,
  DtlsGate,
  HandshakeAssembler,
  isAuthenticRequest,
  isSctpPacket,
  isUserMessage,
  leadingReport,
  parseHandshakeFragments,
  parseRecords,
  Refusals,
  sctpWork,
  serializeHandshake,
  splitClientHello,
  stunKind,
  takeCandidates,
} from '@farpoint/webrtc/parsers';
import {
  clientHello,
  closeAlert,
  connectivityCheck,
  dataChunk,
  dtlsRecord,
  handshakeRecord,
  malformedChunks,
  sctpPacket,
  strayResponse,
} from '@farpoint/webrtc/testing';
import type { FuzzTarget } from '../fuzz-target.ts';

const records = [
  clientHello(),
  closeAlert,
  handshakeRecord(11, [1, 2, 3]),
  dtlsRecord(23, 1, 5, new Uint8Array(40)),
];
const messages = [1, 11, 15, 16, 20].map((type) =>
  serializeHandshake({ type, messageSequence: 0, body: Buffer.alloc(40, type) }),
);
const view = (input: Uint8Array) => Buffer.from(input.buffer, input.byteOffset, input.byteLength);

/** Records decrypt to themselves, so that what comes after decryption is read as well. */
function openEndpoint(): DtlsEndpoint {
  return {
    role: 'server',
    fingerprints: [{ algorithm: 'sha-256', value: '00' }],
    cookie: Buffer.from('cookie'),
    masterSecret: Buffer.alloc(48),
    randoms: Buffer.alloc(64),
    transcript: () => Buffer.alloc(0),
    decrypt: ({ fragment }) => fragment,
    onHandshake: () => undefined,
    resendFlight: () => undefined,
    onData: () => undefined,
    onClosed: () => undefined,
    onFailed: () => undefined,
  };
}

const sdp =
  'v=0\r\no=- 1 0 IN IP4 0.0.0.0\r\ns=-\r\nt=0 0\r\nm=audio 9 UDP/TLS/RTP/SAVPF 96\r\na=ice-ufrag:abcd\r\n' +
  'a=candidate:1 1 udp 2122260223 192.0.2.1 5000 typ host\r\na=end-of-candidates\r\n';

export const transportTargets: readonly FuzzTarget[] = [
  {
    name: 'dtls-record',
    seeds: () => [...records, Buffer.concat(records)],
    run: (input) => void parseRecords(view(input)),
    refusals: [],
  },
  {
    name: 'dtls-handshake',
    seeds: () => [...messages, Buffer.concat(messages)],
    run: (input) => {
      const assembler = new HandshakeAssembler();
      for (const fragment of parseHandshakeFragments(view(input)) ?? []) assembler.add(fragment);
      if (assembler.peek() !== null) assembler.take();
      splitClientHello(view(input));
    },
    refusals: [],
  },
  {
    name: 'dtls-gate',
    seeds: () => [...records, Buffer.concat(records)],
    run: (input) => {
      const gate = new DtlsGate(openEndpoint(), new Refusals());
      gate.onDatagram(view(input));
      gate.onDatagram(view(input));
    },
    refusals: [],
  },
  {
    name: 'stun',
    seeds: () => [
      connectivityCheck({ username: 'abcd:efgh' }),
      connectivityCheck({ username: 'abcd:efgh', password: 'secret' }),
      strayResponse(),
    ],
    run: (input) => {
      if (stunKind(view(input)) === 'request') {
        isAuthenticRequest(view(input), (name) => (name === 'abcd' ? 'secret' : undefined));
      }
    },
    refusals: [],
  },
  {
    name: 'sctp-packet',
    seeds: () => [
      sctpPacket(1, ...dataChunk(1, 1)),
      sctpPacket(1, ...dataChunk(1, 1), ...dataChunk(2, 1)),
      ...[...malformedChunks.values()].map((chunks) => sctpPacket(1, ...chunks)),
    ],
    run: (input) => {
      if (isSctpPacket(view(input))) sctpWork(view(input));
    },
    refusals: [],
  },
  {
    name: 'rtcp-work',
    seeds: () => [
      Buffer.from([
        0x80,
        201,
        0,
        1,
        0,
        0,
        0,
        1,
        0x8f,
        205,
        0,
        4,
        ...new Array(8).fill(1),
        0,
        0,
        255,
        255,
        0,
        0,
        0,
        1,
      ]),
    ],
    run: (input) => {
      compoundWork(view(input));
      leadingReport(view(input));
    },
    refusals: [],
  },
  {
    name: 'dcep',
    seeds: () => [Buffer.from([3, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 97, 98]), Buffer.from([2])],
    run: (input) => void isUserMessage(50, view(input), (input.length & 1) === 0),
    refusals: [],
  },
  {
    name: 'sdp-candidates',
    seeds: () => [Buffer.from(sdp)],
    run: (input) => {
      const { candidates, fragments } = takeCandidates(view(input).toString());
      const gate = new CandidateGate();
      gate.open(fragments);
      for (const candidate of candidates) gate.take(candidate);
    },
    refusals: [],
  },
];
