/** What a bridge sends to a page when it gets known frames, at either level. */
import { knownFrame, type ReadFrame, readKnownFrame } from '../frames.ts';
import type { SocketPeer } from '../peers/socket-peer.ts';
import type { Level } from './suite.ts';

const TIMEOUT_MS = 5000;
const STREAM_INTERVAL_MS = 20;

/**
 * The next message of points. At level `reference`, skips empty ones: one precedes a stream that does not begin at 0.
 */
export async function nextPoints(
  streaming: SocketPeer,
  level: Level,
  timeoutMs = TIMEOUT_MS,
): Promise<Uint8Array> {
  for (;;) {
    const message = await streaming.bytes(timeoutMs);
    if (message.length > 0 || level === 'strict') return message;
  }
}

interface Sender {
  sendFrame(payloads: readonly Uint8Array[]): void;
}

/**
 * Sends known frames, counting up, until one of them is shown. It thus does not matter whether the bridge waits for the
 * next frame.
 *
 * @returns the first frame shown with a number of at least `from`
 */
export async function showFrames(
  sender: Sender,
  from: number,
  points: number,
  streaming: SocketPeer,
  level: Level,
): Promise<ReadFrame> {
  let number = from;
  const timer = setInterval(() => sender.sendFrame(knownFrame(number++, points)), STREAM_INTERVAL_MS);
  try {
    return readKnownFrame(await nextPoints(streaming, level));
  } finally {
    clearInterval(timer);
  }
}
