/**
 * A page's streaming socket in a process of its own: when each message was there to its last byte. Run as a child;
 * tells its parent `ready`, and on any message from it `{arrivals}`.
 */
import { WebSocket } from 'ws';

const [url] = process.argv.slice(2);
if (url === undefined) throw new Error('usage: bridge-reader URL');
const arrivals: { atMs: number; bytes: number }[] = [];
const socket = new WebSocket(url, { perMessageDeflate: false, skipUTF8Validation: true });
socket.on('message', (data: Buffer) => {
  const [seconds, nanoseconds] = process.hrtime();
  arrivals.push({ atMs: seconds * 1000 + nanoseconds / 1e6, bytes: data.byteLength });
});
socket.on('open', () => process.send?.('ready'));
process.on('message', () => process.send?.({ arrivals }, () => process.exit(0)));
