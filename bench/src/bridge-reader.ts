/**
 * A page's streaming socket in its own process. Records when the last byte of each message arrived. It reads into one
 * buffer and keeps nothing, so that its own memory does not delay what it measures. Run as a child process: it sends
 * `ready` to its parent, and answers any message with `{arrivals}`.
 */
import { connect } from 'node:net';
import { setNiceness } from '@farpoint/service';

const [port] = process.argv.slice(2).map(Number);
if (port === undefined) throw new Error('usage: bridge-reader PORT');
// A page's machine is not the robot's, so the reader must not wait while the robot computes.
try {
  setNiceness(-5);
} catch {
  // Without the privilege, it sometimes has to wait.
}

const MAX_ARRIVALS = 100_000;
const HEADER_END = Buffer.from('\r\n\r\n');
const arrivals: { atMs: number; bytes: number }[] = [];
/**
 * The current WebSocket frame (RFC 6455 §5.2): the bytes of its header so far, and the remaining bytes of its
 * payload.
 */
const header = Buffer.alloc(10);
let headerBytes = 0;
let payloadLeft = 0;
let messageBytes = 0;
let upgraded = false;

function onBytes(chunk: Buffer): void {
  let at = 0;
  if (!upgraded) {
    // The service answers in one piece, and sends nothing before the robot's next frame.
    at = chunk.indexOf(HEADER_END) + HEADER_END.length;
    if (!chunk.toString('latin1').startsWith('HTTP/1.1 101')) throw new Error('no WebSocket');
    upgraded = true;
    process.send?.('ready');
  }
  while (at < chunk.length) {
    if (payloadLeft > 0) {
      const taken = Math.min(payloadLeft, chunk.length - at);
      payloadLeft -= taken;
      messageBytes += taken;
      at += taken;
      if (payloadLeft === 0) onFrameEnd();
      continue;
    }
    header[headerBytes++] = chunk[at++] as number;
    const short = (header[1] as number) & 0x7f;
    const needed = headerBytes < 2 ? 2 : short === 127 ? 10 : short === 126 ? 4 : 2;
    if (headerBytes < needed) continue;
    payloadLeft =
      short === 127 ? Number(header.readBigUInt64BE(2)) : short === 126 ? header.readUInt16BE(2) : short;
    headerBytes = 0;
    if (payloadLeft === 0) onFrameEnd();
  }
}

function onFrameEnd(): void {
  const isFinal = ((header[0] as number) & 0x80) !== 0;
  const isControl = ((header[0] as number) & 0x08) !== 0;
  if (isControl || !isFinal) return;
  const [seconds, nanoseconds] = process.hrtime();
  if (arrivals.length < MAX_ARRIVALS)
    arrivals.push({ atMs: seconds * 1000 + nanoseconds / 1e6, bytes: messageBytes });
  messageBytes = 0;
}

const buffer = Buffer.alloc(1 << 20);
const socket = connect({
  host: '127.0.0.1',
  port,
  onread: {
    buffer,
    callback: (bytes) => {
      onBytes(buffer.subarray(0, bytes));
      return true;
    },
  },
});
socket.write(
  [
    'GET / HTTP/1.1',
    `Host: 127.0.0.1:${port}`,
    'Upgrade: websocket',
    'Connection: Upgrade',
    'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==',
    'Sec-WebSocket-Version: 13',
    '\r\n',
  ].join('\r\n'),
);
process.on('message', () => process.send?.({ arrivals }, () => process.exit(0)));
