import type { RTCSctpTransport } from 'werift';
import { abandonMessage, dropOverdue, isWorthless, type OutboundChunk } from '../sctp/abandonment.ts';
import { type Forward, GivenUp } from '../sctp/given-up.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

interface SizedChunk extends OutboundChunk {
  bookSize: number;
}

interface InboundStream {
  popMessages(): Iterable<unknown>;
}

interface SendOptions {
  expiry?: number | undefined;
}

interface AssociationShape {
  send(streamId: number, payloadProtocol: number, data: Buffer, options?: SendOptions): Promise<void>;
  transmitOnce(): Promise<void>;
  updateAdvancedPeerAckPoint(): void;
  timer3Start(): void;
  timer3Handle: unknown;
  forwardTsnChunk: Forward | undefined;
  lastSackedTsn: number;
  localTsn: number;
  maybeAbandon(chunk: SizedChunk): boolean;
  flightSizeDecrease(chunk: SizedChunk): void;
  sentQueue: SizedChunk[];
  outboundQueue: SizedChunk[];
  getInboundStream(streamId: number): InboundStream;
}

interface TransportShape {
  sctp: AssociationShape;
  dataChannels: Record<number, { maxPacketLifeTime: number | null } | undefined>;
}

/**
 * Mends werift's SCTP association, which loses or keeps back messages of reliable channels on a path that loses packets,
 * and sends again those of the others:
 * - It gives up the oldest chunk, instead of the one that is worth nothing any more ({@link abandonMessage}).
 * - Of messages that waited for an earlier one, it hands over those whose numbers follow directly. Others, between which
 *   another channel sent something, stay until something else arrives on their stream: perhaps never.
 * - A lifetime never ends, because it is added to a time in other units; and what waits is sent however old it is.
 * - It tells the peer once of what was given up. If that packet is lost, the peer waits for what will never come.
 * - When nothing was acknowledged for a while, it also sends again what has arrived behind a gap.
 *
 * Call it before the association starts.
 *
 * @throws {WeriftShapeError}
 */
export function mendSctp(transport: RTCSctpTransport): void {
  const shape = transport as unknown as TransportShape;
  const { sctp } = shape;
  expectMethods(sctp, 'the SCTP association', [
    'maybeAbandon',
    'flightSizeDecrease',
    'getInboundStream',
    'send',
    'transmitOnce',
    'updateAdvancedPeerAckPoint',
    'timer3Start',
  ]);
  if (!Array.isArray(sctp.sentQueue) || !Array.isArray(sctp.outboundQueue))
    throw new WeriftShapeError('no queues in the SCTP association');
  giveUpWorthless(sctp);
  endLifetimes(shape);
  repeatForwards(sctp);
  popAllMessages(sctp);
}

function giveUpWorthless(sctp: AssociationShape): void {
  sctp.maybeAbandon = (chunk) => {
    if (chunk.abandoned) return true;
    // It has arrived. If the first has, too, although the peer does not count it, the peer has dropped them again.
    if (chunk.acked && sctp.sentQueue[0]?.acked !== true) return true;
    if (!isWorthless(chunk, Date.now() / 1000)) return false;
    const queues = { sent: sctp.sentQueue, waiting: sctp.outboundQueue };
    // Of the chunk itself, werift takes care.
    for (const other of abandonMessage(chunk, queues)) sctp.flightSizeDecrease(other);
    return true;
  };
}

/** Ends the lifetime of a channel's messages, also of those that wait to be sent. */
function endLifetimes(transport: TransportShape): void {
  const { sctp } = transport;
  const send = sctp.send;
  sctp.send = (streamId, payloadProtocol, data, options) => {
    const lifeTimeMs = transport.dataChannels[streamId]?.maxPacketLifeTime ?? null;
    if (options?.expiry === undefined || lifeTimeMs === null)
      return send(streamId, payloadProtocol, data, options);
    const expiry = (Date.now() + lifeTimeMs) / 1000;
    return send(streamId, payloadProtocol, data, { ...options, expiry });
  };

  const transmitOnce = sctp.transmitOnce.bind(sctp);
  sctp.transmitOnce = () => {
    const dropped = dropOverdue(sctp.outboundQueue, Date.now() / 1000);
    sctp.localTsn = (sctp.localTsn - dropped) >>> 0;
    return transmitOnce();
  };
}

/** Tells the peer what was given up until it has acknowledged that. */
function repeatForwards(sctp: AssociationShape): void {
  const givenUp = new GivenUp();
  const update = sctp.updateAdvancedPeerAckPoint.bind(sctp);
  sctp.updateAdvancedPeerAckPoint = () => {
    const earlier = sctp.forwardTsnChunk;
    update();
    const chunk = sctp.forwardTsnChunk;
    if (chunk !== undefined) {
      if (chunk !== earlier) givenUp.onTold(chunk, performance.now());
      return;
    }
    const due = givenUp.due(sctp.lastSackedTsn, performance.now());
    if (due === 'wait') {
      if (sctp.timer3Handle === undefined) sctp.timer3Start();
    } else if (due !== null) sctp.forwardTsnChunk = due;
  };
}

/** Hands over each message that is due, also if numbers between them belong to other channels. */
function popAllMessages(sctp: AssociationShape): void {
  const getInboundStream = sctp.getInboundStream.bind(sctp);
  const mended = new WeakSet<InboundStream>();
  sctp.getInboundStream = (streamId) => {
    const stream = getInboundStream(streamId);
    if (!mended.has(stream)) {
      mended.add(stream);
      const popMessages = stream.popMessages.bind(stream);
      stream.popMessages = () => untilNone(popMessages);
    }
    return stream;
  };
}

/** Begins anew after each message. */
function* untilNone(popMessages: () => Iterable<unknown>): Generator<unknown> {
  for (;;) {
    const [message] = popMessages();
    if (message === undefined) return;
    yield message;
  }
}
