/** Coded pictures that are pushed: decoded by the real program, or left out, and never its end. */
import { spawnSync } from 'node:child_process';
import { afterEach, describe, expect, it } from 'vitest';
import { encoderNamed, VIDEO_SUITE, Watched } from './testing/helpers.ts';
import type { Coding } from './wire.ts';

const open: Watched[] = [];
afterEach(async () => {
  await Promise.all(open.splice(0).map((each) => each.process.close()));
});

function watch(encoder = 'x264enc', source: 'frames' | 'test' = 'frames', extra = ''): Watched {
  const from =
    source === 'test'
      ? ({ kind: 'test', pattern: 'pinwheel', width: 320, height: 240, framesPerS: 30 } as const)
      : ({ kind: 'frames' } as const);
  const watched = new Watched({
    source: from,
    encoder: encoderNamed(encoder),
    encoderProperties: extra,
    settings: { bitsPerS: 2_000_000 },
  });
  open.push(watched);
  return watched;
}

/** A still picture as a file. */
function still(coding: 'jpeg' | 'png', width: number, height: number): Uint8Array {
  const pipeline = `videotestsrc num-buffers=1 ! video/x-raw,width=${width},height=${height} ! ${coding}enc ! fdsink fd=1`;
  const { stdout } = spawnSync('gst-launch-1.0', ['-q', ...pipeline.split(' ')]);
  return new Uint8Array(stdout);
}

/** Access units of a video, the first of them a key frame. */
async function video(coding: 'h264' | 'vp8', count: number, extra = ''): Promise<Uint8Array[]> {
  const source = watch(coding === 'h264' ? 'x264enc' : 'vp8enc', 'test', extra);
  const frames = await source.next(count);
  await source.process.close();
  return frames.map(({ bytes }) => new Uint8Array(bytes));
}

let lastNs = 0n;
function nextNs(): bigint {
  const now = process.hrtime.bigint();
  lastNs = now > lastNs ? now : lastNs + 1n;
  return lastNs;
}

/** Pushes it as soon as the process takes it. */
async function push(to: Watched, coding: Coding, bytes: Uint8Array, captureNs = nextNs()): Promise<bigint> {
  while (!to.process.pushCoded({ captureNs, coding, bytes }))
    await new Promise((resolve) => setImmediate(resolve));
  return captureNs;
}

/** Pushes it and resolves with the picture that it gives. */
async function pushed(to: Watched, coding: Coding, bytes: Uint8Array) {
  const captureNs = await push(to, coding, bytes);
  await to.until(() => to.frames.at(-1)?.captureNs === captureNs);
  return to.frames.at(-1)!;
}

describe(`coded pictures (${VIDEO_SUITE.note})`, { skip: VIDEO_SUITE.skip }, () => {
  it('of JPEG and PNG keep their capture times, whatever size each has', async () => {
    const to = watch();
    for (const [width, height] of [
      [320, 240],
      [640, 480],
      [162, 122],
    ] as const) {
      for (const coding of ['jpeg', 'png'] as const)
        expect(await pushed(to, coding, still(coding, width, height))).toMatchObject({ width, height });
    }
    expect(to.failures).toEqual([]);
  });

  it.each(['h264', 'vp8'] as const)('of %s come one by one, each with its capture time', async (coding) => {
    const units = await video(coding, 12);
    const to = watch();
    for (const unit of units)
      expect(await pushed(to, coding, unit)).toMatchObject({ width: 320, height: 240 });
    await to.until(() => to.stats !== undefined);
    expect(to.stats).toMatchObject({ damaged: 0, undecoded: 0, refused: 0 });
  });

  it('of H.264 in an order other than that of capture come in that of capture', async () => {
    const pipeline =
      'videotestsrc num-buffers=30 ! video/x-raw,width=320,height=240,framerate=30/1 ! x264enc bframes=2 b-adapt=false key-int-max=30 ! h264parse ! video/x-h264,stream-format=byte-stream,alignment=au,profile=main ! identity ! fdsink fd=1';
    const { stdout } = spawnSync('gst-launch-1.0', ['-q', ...pipeline.split(' ')]);
    const units = accessUnits(new Uint8Array(stdout));
    expect(units.length).toBe(30);
    // I P B B P B B P: the capture times are in another order than the units. So many may wait.
    const order = [0, 3, 1, 2, 6, 4, 5, 9];
    const to = watch();
    // An encoder on a busy machine may leave out all pictures of a round but one.
    for (let round = 0; to.frames.length < 2; round++) {
      for (const [i, position] of order.entries())
        await push(to, 'h264', units[i]!, BigInt(round * 10 + position + 1) * 33_000_000n);
      const { stats, frames } = to;
      await to.until(() => to.stats !== stats && frames.length > 0);
      if (round === 0) expect(to.stats).toMatchObject({ damaged: 0, undecoded: 0 });
    }
    const times = to.frames.map(({ captureNs }) => captureNs);
    expect(times).toEqual([...times].sort((a, b) => (a < b ? -1 : 1)));
  });

  it.each(['h264', 'vp8'] as const)('of %s begin with a key frame', async (coding) => {
    const units = await video(coding, 4);
    const to = watch();
    for (const unit of units.slice(1)) await push(to, coding, unit);
    await pushed(to, coding, units[0]!);
    await to.until(() => to.stats !== undefined);
    expect(to.stats).toMatchObject({ undecoded: 3, damaged: 0 });
    expect(to.frames).toHaveLength(1);
  });

  it('may change their coding, also to raw pictures', async () => {
    const [h264, vp8] = [await video('h264', 2), await video('vp8', 2)];
    const to = watch();
    for (let round = 0; round < 3; round++) {
      for (const unit of h264) await pushed(to, 'h264', unit);
      await pushed(to, 'jpeg', still('jpeg', 320, 240));
      for (const unit of vp8) await pushed(to, 'vp8', unit);
      const next = to.next(1);
      to.process.pushFrame({
        captureNs: process.hrtime.bigint(),
        ...{ format: 'gray', width: 64, height: 48, stride: 64, bytes: new Uint8Array(64 * 48) },
      });
      expect((await next)[0]).toMatchObject({ width: 64, height: 48 });
    }
    expect(to.failures).toEqual([]);
  });

  it.each(['jpeg', 'png', 'h264', 'vp8'] as const)(
    'of %s that are damaged are left out, and the next sound one is shown',
    async (coding) => {
      const sound =
        coding === 'jpeg' || coding === 'png' ? still(coding, 320, 240) : (await video(coding, 1))[0]!;
      const to = watch();
      await pushed(to, coding, sound);
      const random = lcg(7);
      for (let round = 0; round < 30; round++) {
        for (const damaged of damages(sound, random)) await push(to, coding, damaged);
        await pushed(to, coding, sound);
      }
      await to.until(() => (to.stats?.damaged ?? 0) > 0);
      expect(to.failures).toEqual([]);
      expect(to.process.starts).toBe(1);
    },
  );

  it('of sizes that need too much memory are not decoded', async () => {
    const to = watch();
    const bomb = still('png', 64, 48);
    new DataView(bomb.buffer).setUint32(16, 60_000);
    new DataView(bomb.buffer).setUint32(20, 60_000);
    const huge = still('jpeg', 64, 48);
    const sof = huge.findIndex((byte, at) => byte === 0xff && huge[at + 1] === 0xc0);
    new DataView(huge.buffer).setUint16(sof + 5, 65_535);
    await push(to, 'png', bomb);
    await push(to, 'jpeg', huge);
    await to.until(() => to.stats?.damaged === 2);
    await pushed(to, 'jpeg', still('jpeg', 64, 48));
    expect(to.failures).toEqual([]);
  });

  it('that come faster than they can be decoded are left out whole', async () => {
    const to = watch();
    const large = still('png', 1920, 1080);
    let taken = 0;
    for (let i = 0; i < 30; i++) {
      if (to.process.pushCoded({ captureNs: nextNs(), coding: 'png', bytes: large })) taken++;
      await new Promise((resolve) => setImmediate(resolve));
    }
    await to.until(() => {
      const { encoded = 0, undecoded = 0, dropped = 0 } = to.stats ?? {};
      return encoded > 0 && encoded + undecoded + dropped >= taken - 3;
    });
    expect(taken + to.process.notTaken).toBe(30);
  });

  it.each(['h264', 'vp8'] as const)('of %s go on with a key frame after a gap', async (coding) => {
    const units = await video(coding, 40);
    const to = watch();
    // All at once: more than may wait.
    for (const unit of units) await push(to, coding, unit);
    await to.until(() => (to.stats?.undecoded ?? 0) > 0);
    const { length } = to.frames;
    expect(length).toBeLessThan(40);
    await pushed(to, coding, units[0]!);
    await pushed(to, coding, units[1]!);
    expect(to.failures).toEqual([]);
  });

  it('without bytes are refused', () => {
    const to = watch();
    expect(() => to.process.pushCoded({ captureNs: 1n, coding: 'jpeg', bytes: new Uint8Array() })).toThrow(
      RangeError,
    );
  });
});

function lcg(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1_103_515_245) + 12_345) | 0;
    return (state >>> 8) & 0xffff;
  };
}

/** Cut short, with wrong bytes, with other bytes only. */
function damages(sound: Uint8Array, random: () => number): Uint8Array[] {
  const cut = sound.slice(0, 1 + (random() % (sound.length - 1)));
  const wrong = sound.slice();
  for (let i = 0; i < 20; i++) wrong[random() % wrong.length] = random() & 255;
  const head = sound.slice();
  for (let i = 0; i < 5; i++) head[random() % Math.min(head.length, 60)] = random() & 255;
  const noise = Uint8Array.from({ length: 500 }, () => random() & 255);
  return [cut, wrong, head, noise];
}

/** Splits a stream at its access unit delimiters. */
function accessUnits(stream: Uint8Array): Uint8Array[] {
  const starts: number[] = [];
  for (let i = 0; i + 4 < stream.length; i++)
    if (stream[i] === 0 && stream[i + 1] === 0 && stream[i + 2] === 1 && (stream[i + 3]! & 31) === 9)
      starts.push(i > 0 && stream[i - 1] === 0 ? i - 1 : i);
  return starts.map((start, i) => stream.subarray(start, starts[i + 1] ?? stream.length));
}
