/** Cameras on USB and in a network, as the real program sees them. */
import { afterEach, describe, expect, it } from 'vitest';
import { barcodeTime, decodeLuma, encoderNamed, median, VIDEO_SUITE, Watched } from './testing/helpers.ts';
import { RtspCamera, type RtspCoding } from './testing/rtsp-camera.ts';
import { V4l2Camera } from './testing/v4l2-camera.ts';
import type { VideoProcessOptions } from './video-process.ts';

const QUICK_RETRY = { firstMs: 10, mostMs: 200 };
const closing: (() => unknown)[] = [];
afterEach(async () => {
  for (const close of closing.splice(0).reverse()) await close();
});

type Given = Partial<VideoProcessOptions> & Pick<VideoProcessOptions, 'source'>;

function watch(given: Given): Watched {
  const options = { encoder: encoderNamed('x264enc'), settings: { bitsPerS: 2_000_000 }, retry: QUICK_RETRY };
  const watched = new Watched({ ...options, ...given });
  closing.push(() => watched.process.close());
  return watched;
}

/** Everything that came, decoded: the luma of each picture. */
function pictures({ frames }: Watched): Uint8Array[] {
  const { width = 0, height = 0 } = frames[0] ?? {};
  return decodeLuma(Buffer.concat(frames.map(({ bytes }) => bytes)), width, height);
}

const usb = [VIDEO_SUITE, V4l2Camera.suite];
describe(`a camera on USB (${usb.map(({ note }) => note).join('; ')})`, {
  skip: usb.some(({ skip }) => skip),
}, () => {
  function plugIn(): V4l2Camera {
    const camera = new V4l2Camera();
    closing.push(() => camera.remove());
    return camera;
  }
  const on = (camera: V4l2Camera, more: object = {}) => ({
    source: { kind: 'v4l2', device: camera.device, ...more } as const,
    env: { ...process.env, ...camera.environment },
  });

  it.each([
    ['raw', { width: 640, height: 480, framesPerS: 30 }, 33.3],
    ['raw', { width: 320, height: 240, framesPerS: 15 }, 66.7],
    ['jpeg', { framesPerS: 30 }, 33.3],
  ] as const)('%s %o: each picture has the driver’s capture time', async (format, shape, intervalMs) => {
    const camera = plugIn();
    const video = watch(on(camera, { format, ...shape }));
    await video.next(20);
    const { frames } = video;
    expect(frames[0]).toMatchObject({ key: true, ...sizeOf(shape) });
    const taken = camera.taken;
    const levels = format === 'raw' ? pictures(video) : [];
    for (const [i, { captureNs }] of frames.entries()) {
      const off = ({ takenNs }: { takenNs: bigint }) => Math.abs(Number(captureNs - takenNs)) / 1e6;
      const own = taken.reduce((best, each) => (off(each) < off(best) ? each : best));
      expect(off(own)).toBeLessThan(intervalMs / 4);
      // It is that picture, too, and not its neighbour.
      const luma = levels[i];
      if (luma !== undefined) expect(Math.abs(luma[luma.length >> 1]! - own.level)).toBeLessThan(4);
    }
    const gaps = frames.slice(1).map(({ captureMs }, i) => captureMs - frames[i]!.captureMs);
    expect(median(gaps)).toBeGreaterThan(0.9 * intervalMs);
    expect(median(gaps)).toBeLessThan(1.1 * intervalMs);
    expect(video.failures).toEqual([]);
  });

  it('goes on as it is when its picture is made smaller and larger again', async () => {
    const camera = plugIn();
    const video = watch(on(camera));
    await video.next(5);
    for (const width of [320, 160, undefined]) {
      video.process.configure({ width });
      await video.until(() => video.frames.at(-1)?.width === (width ?? 640));
    }
    expect(camera.streams).toBe(1);
    expect(video.failures).toEqual([]);
  });

  it('a size that the camera does not have is refused, with what to do', async () => {
    const video = watch(on(plugIn(), { width: 1920, height: 1080 }));
    await video.until(() => video.failures.length > 0);
    expect(video.failures[0]).toMatchObject({ reason: 'not-negotiated', retried: false });
    expect(video.failures[0]?.remedy).toContain('v4l2-ctl --list-formats-ext');
  });

  it('that is pulled out is lost, and comes back with a key frame when it is plugged in again', async () => {
    const camera = plugIn();
    const video = watch(on(camera));
    await video.next(5);
    camera.unplug();
    await video.until(() => video.failures.length > 0);
    expect(video.failures[0]).toMatchObject({ reason: 'source-lost', retried: true });
    camera.plugIn();
    const [first] = await video.next(1);
    expect(first?.key).toBe(true);
    await video.next(5);
  });
});

function sizeOf(shape: { width?: number; height?: number; framesPerS: number }) {
  const { width = 640, height = 480 } = shape;
  return { width, height };
}

const network = [VIDEO_SUITE, RtspCamera.suite];
describe(`a camera in a network (${network.map(({ note }) => note).join('; ')})`, {
  skip: network.some(({ skip }) => skip),
}, () => {
  async function start(...given: Parameters<typeof RtspCamera.start>): Promise<RtspCamera> {
    const camera = await RtspCamera.start(...given);
    closing.push(() => camera.kill());
    return camera;
  }

  it.each([
    ['h264', 'tcp'],
    ['h264', 'udp'],
    ['jpeg', 'tcp'],
  ] as const)('%s over %s: live, and dated by its arrival', async (coding: RtspCoding, transport) => {
    const camera = await start(coding);
    const video = watch({ source: { kind: 'rtsp', url: camera.url(), transport } });
    await video.next(60);
    const { frames } = video;
    expect(frames[0]).toMatchObject({ key: true, width: 320, height: 240 });
    // From the camera's own clock, which is in its picture, to the arrival by which we date it.
    const delays = pictures(video).map((luma, i) => {
      const madeNs = barcodeTime(luma, 320);
      return Number((frames[i]?.captureNs ?? 0n) - madeNs) / 1e6;
    });
    expect(delays.length).toBeGreaterThan(50);
    const late = median(delays.slice(-30));
    console.log(`${coding} over ${transport}: ${late.toFixed(1)} ms`);
    expect(late).toBeGreaterThan(-5);
    expect(late).toBeLessThan(300);
    expect(median(frames.slice(-30).map(({ ageMs }) => ageMs))).toBeLessThan(500);
    expect(video.failures).toEqual([]);
  });

  it('is shown with the right password, and with a wrong one says why, without saying it', async () => {
    const camera = await start('h264', 0, ['me', 'secret']);
    const video = watch({ source: { kind: 'rtsp', url: camera.url('me:secret') } });
    await video.next(5);
    const stranger = watch({ source: { kind: 'rtsp', url: camera.url('me:password1') } });
    await stranger.until(() => stranger.failures.length > 0);
    expect(stranger.failures[0]).toMatchObject({ reason: 'source-lost', retried: true });
    expect(stranger.failures[0]?.sentence).toMatch(/Unauthorized/);
    expect(stranger.failures[0]?.sentence).not.toContain('password1');
    expect(stranger.frames).toEqual([]);
  });

  it('that goes off is lost, and comes back with a key frame', async () => {
    const camera = await start();
    const video = watch({ source: { kind: 'rtsp', url: camera.url() }, silenceMs: 2000 });
    await video.next(5);
    await camera.kill();
    await video.until(() => video.failures.length > 0);
    expect(video.failures[0]).toMatchObject({ reason: 'source-lost', retried: true });
    await start('h264', camera.port);
    const [first] = await video.next(1);
    expect(first?.key).toBe(true);
    await video.next(5);
  });
});
