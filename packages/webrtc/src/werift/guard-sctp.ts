import type { RTCSctpTransport } from 'werift';
import type { PeerBudget } from '../peer-budget.ts';
import type { Refusals } from '../refusal.ts';
import { beginsAssociation, isSctpPacket } from '../sctp/packet-check.ts';
import { sctpWork } from '../sctp/packet-work.ts';
import { type Excess, excessOf, type Fragment, MAX_OPENINGS } from '../sctp/receive-bound.ts';
import { DCEP_OPEN, isUserMessage, PayloadProtocol } from '../sctp/user-message-check.ts';
import { boundSctp } from './bound-sctp.ts';
import { mendSctp } from './mend-sctp.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

type Receive = (streamId: number, payloadProtocol: number, data: Buffer) => Promise<void>;
type Send = (streamId: number, payloadProtocol: number, data: Buffer, options?: unknown) => Promise<void>;

interface AssociationShape {
  state: string;
  handleData(packet: Buffer): Promise<void>;
  receiveDataChunk(chunk: Fragment): void;
  inboundStreams: Record<number, { reassembly: Fragment[] } | undefined>;
  lastReceivedTsn: number | undefined;
  send: Send;
  onReceive: { allUnsubscribe(): void; subscribe(receive: (...args: Parameters<Receive>) => void): unknown };
}

interface TransportShape {
  sctp: AssociationShape;
  dataChannels: Record<string, { ordered: boolean } | undefined>;
  datachannelReceive: Receive;
}

/** Channel types of RFC 8832 §5.1: this bit marks the channel as unordered. */
const UNORDERED = 0x80;

/** A peer exceeded what an association may hold; nothing more is taken from it. */
export class ExcessError extends Error {
  override readonly name = 'ExcessError';
}

/**
 * Checks what arrives at an SCTP association before werift parses it. An error that werift still throws ends with the
 * packet; unguarded, it would be an unhandled rejection and end the process.
 *
 * What is more than the peer's budget is dropped: SCTP sends again what must arrive, and slows down.
 *
 * @param onFault called if one of our listeners throws while handling a message, and with an {@link ExcessError}
 * @throws {WeriftShapeError}
 */
export function guardSctp(
  transport: RTCSctpTransport,
  refusals: Refusals,
  budget: PeerBudget,
  onFault: (error: unknown) => void,
): void {
  const shape = transport as unknown as TransportShape;
  const { sctp } = shape;
  expectMethods(shape, 'the SCTP transport', ['datachannelReceive']);
  expectMethods(sctp, 'the SCTP association', ['handleData', 'receiveDataChunk', 'send']);
  expectMethods(sctp.onReceive, 'the SCTP association', ['allUnsubscribe', 'subscribe']);

  if (typeof sctp.inboundStreams !== 'object')
    throw new WeriftShapeError('no streams in the SCTP association');
  mendSctp(transport);
  const gate = new ExcessGate(sctp, refusals, onFault);
  const isRepeated = boundSctp(sctp, {
    onExcess: (excess) => gate.shut(excess),
    onFalseAck: () => refusals.add('sctp-false-ack'),
  });
  guardPackets(sctp, gate, refusals, budget);
  guardChunks(sctp, gate, isRepeated);
  guardMessages(shape, gate, refusals, onFault);
  markUnordered(shape);
}

/** Lets nothing more through once the peer has exceeded what an association may hold. */
class ExcessGate {
  readonly #sctp: AssociationShape;
  readonly #refusals: Refusals;
  readonly #onFault: (error: unknown) => void;
  #isShut = false;

  constructor(sctp: AssociationShape, refusals: Refusals, onFault: (error: unknown) => void) {
    this.#sctp = sctp;
    this.#refusals = refusals;
    this.#onFault = onFault;
  }

  get isShut(): boolean {
    return this.#isShut;
  }

  /** Counts and reports the first excess only. */
  shut(excess: Excess): void {
    if (this.#isShut) return;
    this.#isShut = true;
    // Frees what was held.
    this.#sctp.inboundStreams = {};
    this.#refusals.add(excess);
    this.#onFault(new ExcessError(excess));
  }
}

function guardPackets(
  sctp: AssociationShape,
  gate: ExcessGate,
  refusals: Refusals,
  budget: PeerBudget,
): void {
  const handleData = sctp.handleData.bind(sctp);
  sctp.handleData = async (packet) => {
    if (gate.isShut) return;
    if (!isSctpPacket(packet)) {
      refusals.add('sctp-malformed');
    } else if (!budget.take('sctp', sctpWork(packet), performance.now())) {
      refusals.add('sctp-rate-limited');
    } else if (sctp.state === 'connected' && beginsAssociation(packet)) {
      // It would set all numbers anew, also if it is an old one that arrives late.
      refusals.add('sctp-out-of-order');
    } else {
      await handleData(packet).catch(() => refusals.add('sctp-failed'));
    }
  };
}

function guardChunks(sctp: AssociationShape, gate: ExcessGate, isRepeated: (tsn: number) => boolean): void {
  const receiveDataChunk = sctp.receiveDataChunk.bind(sctp);
  sctp.receiveDataChunk = (chunk) => {
    if (gate.isShut || isRepeated(chunk.tsn)) return;
    const excess = excessOf(chunk, { streams: sctp.inboundStreams, lastTsn: sctp.lastReceivedTsn });
    if (excess === null) receiveDataChunk(chunk);
    else gate.shut(excess);
  };
}

function guardMessages(
  transport: TransportShape,
  gate: ExcessGate,
  refusals: Refusals,
  onFault: (error: unknown) => void,
): void {
  const { sctp } = transport;
  let openings = 0;
  sctp.onReceive.allUnsubscribe();
  sctp.onReceive.subscribe((streamId, payloadProtocol, data) => {
    if (!isUserMessage(payloadProtocol, data, transport.dataChannels[streamId] !== undefined)) {
      refusals.add('message-malformed');
      return;
    }
    const opens = payloadProtocol === PayloadProtocol.dcep && data[0] === DCEP_OPEN;
    if (opens && ++openings > MAX_OPENINGS) {
      gate.shut('too-many-channels');
      return;
    }
    transport.datachannelReceive(streamId, payloadProtocol, data).catch(onFault);
  });
}

/** werift announces unordered channels with a limit as ordered ones. */
function markUnordered(transport: TransportShape): void {
  const { sctp } = transport;
  const send = sctp.send;
  sctp.send = (streamId, payloadProtocol, data, options) => {
    const isOpen = payloadProtocol === PayloadProtocol.dcep && data[0] === DCEP_OPEN && data.length > 1;
    if (isOpen && transport.dataChannels[streamId]?.ordered === false) {
      data.writeUInt8(data.readUInt8(1) | UNORDERED, 1);
    }
    return send(streamId, payloadProtocol, data, options);
  };
}
