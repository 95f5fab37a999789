/**
 * Which chunks go when a message is given up (partial reliability, RFC 3758 §3.5). werift gives up the oldest chunk that
 * it has sent, whichever it was: beside a channel that may lose messages, one that may not loses some, too.
 */
import { FIRST_FRAGMENT, LAST_FRAGMENT, UNORDERED } from './layout.ts';

/** A DATA chunk (RFC 9260 §3.3.1) at its sender. */
export interface OutboundChunk {
  tsn: number;
  flags: number;
  /** Its message is given up: it is not sent again, and the peer is told not to wait for it. */
  abandoned: boolean;
  /** It waits to be sent again. */
  retransmit: boolean;
  /** The peer has it. */
  acked: boolean;
  sentCount: number;
  /** How often it may be sent again; undefined: without limit. */
  maxRetransmits?: number | undefined;
  /** When it is no longer worth sending, s since 1970; undefined: never. */
  expiry?: number | undefined;
}

export interface Outbound<Chunk extends OutboundChunk> {
  /** Sent and not acknowledged in order, by their numbers. */
  sent: Chunk[];
  /** Not sent yet: they follow. */
  waiting: Chunk[];
}

/** Whether a chunk that was lost is not sent again. @param nowS s since 1970 */
export function isWorthless({ maxRetransmits, expiry, sentCount }: OutboundChunk, nowS: number): boolean {
  return (maxRetransmits !== undefined && maxRetransmits < sentCount) || isOverdue(expiry, nowS);
}

/**
 * Drops messages whose time is over before any of them was sent, and gives their numbers to those that follow: a peer
 * does not miss what never had a number. Messages of ordered channels are numbered twice, and stay.
 *
 * @param waiting what is not sent yet, in the order of the numbers; changed in place
 * @returns how many numbers are free again
 */
export function dropOverdue(waiting: OutboundChunk[], nowS: number): number {
  let kept = 0;
  let drops = false;
  const first = waiting[0]?.tsn ?? 0;
  for (const chunk of waiting) {
    // All fragments of a message share its fate; the first in line may be the rest of one that is on its way.
    if (isFirst(chunk)) drops = (chunk.flags & UNORDERED) !== 0 && isOverdue(chunk.expiry, nowS);
    if (drops) continue;
    chunk.tsn = (first + kept) >>> 0;
    waiting[kept++] = chunk;
  }
  const dropped = waiting.length - kept;
  waiting.length = kept;
  return dropped;
}

/**
 * Gives up the message of a chunk, and nothing else. Fragments of it that were not sent yet count as sent: the numbers
 * are theirs, so that the peer must be told of them.
 *
 * @param chunk one of those that were sent
 * @returns the fragments that were on their way until now, besides the chunk
 */
export function abandonMessage<Chunk extends OutboundChunk>(
  chunk: Chunk,
  { sent, waiting }: Outbound<Chunk>,
): Chunk[] {
  const at = sent.indexOf(chunk);
  if (at < 0) return [];
  let first = at;
  while (!isFirst(sent[first]) && follows(sent[first - 1], sent[first])) first--;
  let last = at;
  while (!isLast(sent[last]) && follows(sent[last], sent[last + 1])) last++;
  while (last === sent.length - 1 && !isLast(sent[last]) && follows(sent[last], waiting[0])) {
    sent.push(waiting.shift() as Chunk);
    last++;
  }
  const underway: Chunk[] = [];
  for (const one of sent.slice(first, last + 1)) {
    const wasUnderway = one.sentCount > 0 && !one.acked && !one.retransmit && !one.abandoned;
    if (wasUnderway && one !== chunk) underway.push(one);
    one.abandoned = true;
    one.retransmit = false;
  }
  return underway;
}

function isOverdue(expiry: number | undefined, nowS: number): boolean {
  return expiry !== undefined && expiry < nowS;
}

function isFirst(chunk: OutboundChunk | undefined): boolean {
  return chunk === undefined || (chunk.flags & FIRST_FRAGMENT) !== 0;
}

function isLast(chunk: OutboundChunk | undefined): boolean {
  return chunk === undefined || (chunk.flags & LAST_FRAGMENT) !== 0;
}

/** A message's fragments have consecutive numbers (RFC 9260 §6.9). */
function follows(before: OutboundChunk | undefined, after: OutboundChunk | undefined): boolean {
  return before !== undefined && after !== undefined && (before.tsn + 1) >>> 0 === after.tsn;
}
