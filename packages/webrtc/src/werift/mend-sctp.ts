import type { RTCSctpTransport } from 'werift';
import { abandonMessage, isWorthless, type OutboundChunk } from '../sctp/abandonment.ts';
import { expectMethods, WeriftShapeError } from './werift-shape.ts';

interface SizedChunk extends OutboundChunk {
  bookSize: number;
}

interface InboundStream {
  popMessages(): Iterable<unknown>;
}

interface AssociationShape {
  maybeAbandon(chunk: SizedChunk): boolean;
  flightSizeDecrease(chunk: SizedChunk): void;
  sentQueue: SizedChunk[];
  outboundQueue: SizedChunk[];
  getInboundStream(streamId: number): InboundStream;
}

/**
 * Mends werift's SCTP association, which loses or keeps back messages of reliable channels on a path that loses packets:
 * - It gives up the oldest chunk, instead of the one that is worth nothing any more ({@link abandonMessage}).
 * - Of messages that waited for an earlier one, it hands over those whose numbers follow directly. Others, between which
 *   another channel sent something, stay until something else arrives on their stream: perhaps never.
 *
 * Call it before the association starts.
 *
 * @throws {WeriftShapeError}
 */
export function mendSctp(transport: RTCSctpTransport): void {
  const { sctp } = transport as unknown as { sctp: AssociationShape };
  expectMethods(sctp, 'the SCTP association', ['maybeAbandon', 'flightSizeDecrease', 'getInboundStream']);
  if (!Array.isArray(sctp.sentQueue) || !Array.isArray(sctp.outboundQueue))
    throw new WeriftShapeError('no queues in the SCTP association');

  sctp.maybeAbandon = (chunk) => {
    if (chunk.abandoned) return true;
    if (!isWorthless(chunk, Date.now() / 1000)) return false;
    const queues = { sent: sctp.sentQueue, waiting: sctp.outboundQueue };
    // Of the chunk itself, werift takes care.
    for (const other of abandonMessage(chunk, queues)) sctp.flightSizeDecrease(other);
    return true;
  };

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
