import { type Excess, MAX_STREAMS } from '../sctp/receive-bound.ts';
import { clipBlocks, type GapBlock, MAX_BLOCKS, MAX_REPEATED, writeSack } from '../sctp/sack.ts';
import { TsnWindow } from '../sctp/tsn-window.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

/** Of a message: stream, protocol, data. */
type Message = [streamId: number, payloadProtocol: number, data: Buffer];

interface InboundStream {
  streamSequenceNumber: number;
  popMessages(): Iterable<Message>;
  /** @returns bytes of the fragments that went */
  pruneChunks(tsn: number): number;
}

interface ReconfigParameter {
  type: number;
  streams?: number[];
}

interface AssociationShape {
  readonly isStopped: boolean;
  lastReceivedTsn: number | undefined;
  localTsn: number;
  lastSackedTsn: number;
  advertisedRwnd: number;
  sackNeeded: boolean;
  sackImmediate: boolean;
  sackPacketCount: number;
  inboundStreams: Record<number, InboundStream | undefined>;
  outboundStreamSeq: Record<number, number | undefined>;
  outboundQueue: { tsn: number }[];
  markReceived(tsn: number): boolean;
  sendSack(): Promise<void>;
  sendChunk(chunk: { bytes: Buffer }): Promise<void>;
  receiveForwardTsnChunk(chunk: { cumulativeTsn: number; streams: [number, number][] }): void;
  receiveSackChunk(chunk: { cumulativeTsn: number; gaps: GapBlock[] }): Promise<void>;
  receiveReconfigParam(parameter: ReconfigParameter): Promise<void>;
  getInboundStream(streamId: number): InboundStream;
  receive(...message: Message): void;
}

export interface SctpBoundEvents {
  /** The peer exceeded what the association may hold. */
  onExcess(excess: Excess): void;
  /** The peer acknowledges what was never sent; nothing of it is believed. */
  onFalseAck(): void;
}

const OUTGOING_RESET = 13;

/**
 * Replaces what werift does with the numbers of an association: its time and memory grow with the number of gaps, of
 * streams or of whatever a few bytes can name. Afterwards, what a packet costs depends on its length only.
 *
 * Call it after `mendSctp` and before the association starts.
 *
 * @returns whether a number has been received before; such a chunk is acknowledged and needs nothing else
 * @throws {WeriftShapeError}
 */
export function boundSctp(association: object, events: SctpBoundEvents): (tsn: number) => boolean {
  const sctp = association as AssociationShape;
  expectMethods(sctp, 'the SCTP association', [
    'markReceived',
    'sendSack',
    'sendChunk',
    'receiveForwardTsnChunk',
    'receiveSackChunk',
    'receiveReconfigParam',
    'getInboundStream',
    'receive',
  ]);
  if (typeof sctp.outboundStreamSeq !== 'object' || typeof sctp.lastSackedTsn !== 'number')
    throw new WeriftShapeError('no numbers in the SCTP association');
  const numbers = new ReceivedNumbers(sctp);
  sctp.markReceived = (tsn) => numbers.mark(tsn);
  sctp.sendSack = () => numbers.sendSack();
  boundSkips(sctp, numbers, events);
  boundAcknowledgements(sctp, events);
  boundResets(sctp);
  return (tsn) => numbers.isRepeated(tsn);
}

/** The numbers that have arrived at an association, in place of werift's list of them. */
class ReceivedNumbers {
  readonly #sctp: AssociationShape;
  readonly #repeated: number[] = [];
  #window = new TsnWindow(0);

  constructor(sctp: AssociationShape) {
    this.#sctp = sctp;
  }

  /** Whether it has been received before. If so, the next acknowledgement says that. */
  isRepeated(tsn: number): boolean {
    if (this.#current()?.has(tsn) !== true) return false;
    this.#sctp.sackNeeded = true;
    this.#sctp.sackImmediate = true;
    if (this.#repeated.length < MAX_REPEATED) this.#repeated.push(tsn);
    return true;
  }

  /** @returns whether nothing more is to be done with it */
  mark(tsn: number): boolean {
    const known = this.#current();
    if (known?.add(tsn) !== true) return true;
    this.#sctp.lastReceivedTsn = known.last;
    return false;
  }

  /** The peer has given up every number up to this one. @returns false if that is nothing new */
  skipTo(tsn: number): boolean {
    const known = this.#current();
    this.#sctp.sackNeeded = true;
    this.#sctp.sackImmediate = true;
    if (known?.skipTo(tsn) !== true) return false;
    this.#sctp.lastReceivedTsn = known.last;
    return true;
  }

  async sendSack(): Promise<void> {
    const sctp = this.#sctp;
    const known = this.#current();
    if (sctp.isStopped || !sctp.sackNeeded || known === null) return;
    const bytes = writeSack({
      last: known.last,
      room: sctp.advertisedRwnd,
      blocks: known.blocks(MAX_BLOCKS),
      repeated: this.#repeated,
    });
    this.#repeated.length = 0;
    sctp.sackNeeded = false;
    sctp.sackImmediate = false;
    sctp.sackPacketCount = 0;
    await sctp.sendChunk({ bytes }).catch(() => undefined);
  }

  /** `null` before the association begins, which also sets its first number. */
  #current(): TsnWindow | null {
    const { lastReceivedTsn } = this.#sctp;
    if (lastReceivedTsn === undefined) return null;
    if (this.#window.last !== lastReceivedTsn) this.#window = new TsnWindow(lastReceivedTsn);
    // werift counts down from 0 to -1.
    this.#sctp.lastReceivedTsn = this.#window.last;
    return this.#window;
  }
}

/** Opens no more than {@link MAX_STREAMS} of the streams that a FORWARD TSN (RFC 3758) names. */
function boundSkips(sctp: AssociationShape, numbers: ReceivedNumbers, events: SctpBoundEvents): void {
  sctp.receiveForwardTsnChunk = ({ cumulativeTsn, streams }) => {
    if (!numbers.skipTo(cumulativeTsn)) return;
    let room = MAX_STREAMS - Object.keys(sctp.inboundStreams).length;
    // Each stream once, whatever the list says.
    for (const [streamId, sequence] of new Map(streams)) {
      if (sctp.inboundStreams[streamId] === undefined && room-- <= 0) {
        events.onExcess('sctp-overfull');
        return;
      }
      const stream = sctp.getInboundStream(streamId);
      stream.streamSequenceNumber = (sequence + 1) & 0xffff;
      for (const message of stream.popMessages()) {
        sctp.advertisedRwnd += message[2].length;
        sctp.receive(...message);
      }
    }
    // Not what follows in order: it arrived, and is part of messages that go on.
    for (const stream of Object.values(sctp.inboundStreams)) {
      sctp.advertisedRwnd += stream?.pruneChunks(cumulativeTsn) ?? 0;
    }
  };
}

/** Believes no acknowledgement of what was never sent. */
function boundAcknowledgements(sctp: AssociationShape, events: SctpBoundEvents): void {
  const receiveSackChunk = sctp.receiveSackChunk.bind(sctp);
  sctp.receiveSackChunk = async (chunk) => {
    const next = sctp.outboundQueue[0]?.tsn ?? sctp.localTsn;
    // Modulo 2^32: what is acknowledged lies between the last acknowledged and the last sent.
    const sent = (next - 1 - sctp.lastSackedTsn) >>> 0;
    const acknowledged = (chunk.cumulativeTsn - sctp.lastSackedTsn) >>> 0;
    const isOld = acknowledged >= 2 ** 31;
    if (!isOld && acknowledged > sent) {
      events.onFalseAck();
      return;
    }
    if (!isOld) clipBlocks(chunk.gaps, sent - acknowledged);
    await receiveSackChunk(chunk);
  };
}

/** Resets only streams that there are, each once. */
function boundResets(sctp: AssociationShape): void {
  const receiveReconfigParam = sctp.receiveReconfigParam.bind(sctp);
  sctp.receiveReconfigParam = (parameter) => {
    if (parameter.type === OUTGOING_RESET && parameter.streams !== undefined) {
      const isUsed = (id: number) =>
        sctp.inboundStreams[id] !== undefined || sctp.outboundStreamSeq[id] !== undefined;
      parameter.streams = [...new Set(parameter.streams)].filter(isUsed);
    }
    return receiveReconfigParam(parameter);
  };
}
