/** What happens to real cameras: unplugged and plugged in again, and more pictures than the encoder can take. */
import { once } from 'node:events';
import { type AddressInfo, createServer, type Server, type Socket } from 'node:net';
import { afterEach, describe, expect, it } from 'vitest';
import { encoderNamed, VIDEO_SUITE, Watched } from './testing/helpers.ts';

let watched: Watched | null = null;
afterEach(() => watched?.process.close());

const [WIDTH, HEIGHT] = [64, 48];

/** Stands in for a camera: it can be connected to while it is plugged in, and gives grey pictures. */
class CameraOnSocket {
  port = 0;
  #server: Server | null = null;
  readonly #sockets = new Set<Socket>();

  async plugIn(): Promise<void> {
    const picture = new Uint8Array(WIDTH * HEIGHT).fill(80);
    const server = createServer((socket) => {
      this.#sockets.add(socket);
      const timer = setInterval(() => socket.write(picture), 30);
      socket.on('error', () => undefined);
      socket.on('close', () => {
        clearInterval(timer);
        this.#sockets.delete(socket);
      });
    });
    server.listen(this.port, '127.0.0.1');
    await once(server, 'listening');
    this.port = (server.address() as AddressInfo).port;
    this.#server = server;
  }

  async unplug(): Promise<void> {
    const server = this.#server;
    this.#server = null;
    if (server === null) return;
    const closed = once(server, 'close');
    server.close();
    for (const socket of this.#sockets) socket.destroy();
    await closed;
  }
}

describe(`faults of cameras (${VIDEO_SUITE.note})`, { skip: VIDEO_SUITE.skip }, () => {
  it('one that is unplugged comes back when it is plugged in again, however often', async () => {
    const camera = new CameraOnSocket();
    await camera.plugIn();
    const video = new Watched({
      source: {
        kind: 'gst',
        pipeline: `tcpclientsrc host=127.0.0.1 port=${camera.port} do-timestamp=true ! rawvideoparse width=${WIDTH} height=${HEIGHT} format=gray8`,
      },
      encoder: encoderNamed('vp8enc'),
      settings: { bitsPerS: 500_000 },
      retry: { firstMs: 1, mostMs: 20 },
    });
    watched = video;
    try {
      for (let round = 0; round < 2; round++) {
        await video.next(5);
        const { length } = video.failures;
        await camera.unplug();
        // At least one attempt meets no camera at all.
        await video.until(() => video.failures.length >= length + 2);
        for (const failure of video.failures.slice(length))
          expect(failure).toMatchObject({ reason: 'source-lost', retried: true });
        await camera.plugIn();
        const [first] = await video.next(1);
        expect(first).toMatchObject({ key: true, width: WIDTH, height: HEIGHT });
      }
    } finally {
      await camera.unplug();
    }
  });

  it('an encoder that hangs is ended, although its process lives', async () => {
    const video = new Watched({
      source: { kind: 'test', width: 320, height: 240, framesPerS: 30 },
      // Sleeps for a quarter of an hour with its first picture.
      encoder: { ...encoderNamed('x264enc'), before: 'identity sleep-time=900000000' },
      settings: { bitsPerS: 1_000_000 },
    });
    watched = video;
    await video.until(() => video.failures.length === 1);
    expect(video.failures[0]).toMatchObject({ reason: 'encoder-failed', retried: true });
    expect(video.failures[0]?.sentence).toMatch(/it has given no picture for 10 s, while \d{2,} came/);
    await video.until(() => video.process.starts === 2 && video.states.length > 0);
  });

  it('an encoder at a quarter of the needed speed drops pictures, and lets few wait', async () => {
    const slowMs = 4 * (1000 / 30);
    const video = new Watched({
      source: { kind: 'test', pattern: 'ball', width: 320, height: 240, framesPerS: 30 },
      encoder: { ...encoderNamed('x264enc'), before: `identity sleep-time=${Math.round(slowMs * 1000)}` },
      settings: { bitsPerS: 1_000_000 },
    });
    watched = video;
    // How old they are in ms: `pnpm bench cameras`.
    await video.until(() => (video.stats?.dropped ?? 0) > 60 && (video.stats?.encoded ?? 0) > 10);
    const { framesIn, dropped, encoded } = video.stats!;
    expect(Math.abs(framesIn - dropped - encoded)).toBeLessThanOrEqual(8);
  });
});
