/** The program by itself: sound goes in at one end and comes out at the other. */
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { eventually } from '@farpoint/service/testing/eventually';
import { useFolder } from '@farpoint/service/testing/folder';
import { describe, expect, it, onTestFinished } from 'vitest';
import { Loudspeaker } from './loudspeaker.ts';
import { Microphone } from './microphone.ts';
import { opusDurationMs } from './opus-packet.ts';
import type { SoundFailure } from './sound-failure.ts';
import { Arrivals, nowMs, SOUND_SUITE } from './testing/helpers.ts';
import { samplesOf, toneShare } from './testing/tone.ts';
import type { SoundPacket } from './wire.ts';

const retry = { firstMs: 20, mostMs: 40 };
const folder = useFolder();

type Packet = SoundPacket & { ageMs: number };

function microphone(source: ConstructorParameters<typeof Microphone>[0]['source'], more: object = {}) {
  const packets = new Arrivals<Packet>();
  const failures = new Arrivals<SoundFailure>();
  const device = new Microphone({
    ...{ source, bitsPerS: 32_000, retry, ...more },
    onPacket: (packet) => packets.add({ ...packet, ageMs: nowMs() - packet.capturedAtMs }),
    onFailure: failures.add,
  });
  onTestFinished(() => device.close());
  return { device, packets, failures };
}

function loudspeaker(pipeline: string, more: object = {}) {
  const failures = new Arrivals<SoundFailure>();
  const started = new Arrivals<true>();
  const sink = { kind: 'gst', pipeline } as const;
  const device = new Loudspeaker({
    ...{ sink, retry, ...more },
    onFailure: failures.add,
    onStarted: () => started.add(true),
  });
  onTestFinished(() => device.close());
  return { device, failures, started };
}

describe(`farpoint-sound (${SOUND_SUITE.note})`, { skip: SOUND_SUITE.skip }, () => {
  it.each([10, 20] as const)('gives packets of %i ms with the time of their capture', async (packetMs) => {
    const { packets } = microphone({ kind: 'test' }, { packetMs });
    // The encoder begins with sound from before the beginning, so the first packet is shorter.
    const given = (await packets.atLeast(31)).slice(1, 31);
    expect(given.map(({ bytes }) => opusDurationMs(bytes))).toEqual(given.map(() => packetMs));
    const steps = given
      .slice(1)
      .map(({ capturedAtMs }, i) => (capturedAtMs - given[i]!.capturedAtMs) / packetMs);
    // A busy machine loses packets, and the others keep their times.
    for (const step of steps) expect(step).toBeCloseTo(Math.round(step), 3);
    expect(steps.filter((step) => Math.round(step) === 1).length).toBeGreaterThan(0.8 * steps.length);
    for (const { ageMs } of given) expect(ageMs).toBeGreaterThan(0);
  });

  it('follows a new rate while it runs', async () => {
    const noise = { kind: 'gst', pipeline: 'audiotestsrc wave=white-noise samplesperbuffer=480' } as const;
    const { device, packets } = microphone(noise, { bitsPerS: 64_000 });
    const bytesOf = (given: Packet[]) => given.reduce((sum, { bytes }) => sum + bytes.length, 0);
    const fast = bytesOf((await packets.atLeast(30)).slice(10, 30));
    device.configure(16_000);
    const from = packets.all.length + 10;
    const slow = bytesOf((await packets.atLeast(from + 20)).slice(from, from + 20));
    expect(fast / slow).toBeGreaterThan(2);
  });

  it('plays what a microphone gives, and conceals what is missing', async () => {
    const file = join(folder, 'played.raw');
    const tone = microphone({ kind: 'test', frequency: 600 });
    const { device, started } = loudspeaker(
      `audio/x-raw,format=S16LE,rate=48000,channels=1 ! filesink location=${file} buffer-mode=unbuffered`,
    );
    await started.atLeast(1);
    const firstMs = nowMs() + 40;
    for (let i = 0; i < 40; i++) {
      const { bytes } = (await tone.packets.atLeast(i + 1))[i]!;
      expect(device.play(firstMs + i * 20, 20, i % 10 === 5 ? new Uint8Array(0) : bytes)).toBe(true);
    }
    const whole = 40 * 960 * 2;
    await eventually(() => statSync(file).size >= whole * 0.9);
    const samples = samplesOf(readFileSync(file)).slice(4800);
    expect(toneShare(samples, 600, 48_000)).toBeGreaterThan(0.8);
    expect(toneShare(samples, 900, 48_000)).toBeLessThan(0.05);
  });

  it.each([
    ['parse', 'audiotestsrc ! ! fakesink'],
    ['no-element', 'nosuchsrc'],
    ['device-lost', 'audiotestsrc num-buffers=3'],
    ['device-lost', 'filesrc location=/no/such/file ! wavparse'],
  ])('says %s for the microphone %s', async (reason, pipeline) => {
    const { failures } = microphone({ kind: 'gst', pipeline });
    const [failure] = await failures.atLeast(1);
    expect(failure).toMatchObject({ reason });
    expect(failure?.remedy).not.toBe('');
  });

  it('says why a loudspeaker cannot be opened, and tries again', async () => {
    const { device, failures } = loudspeaker('filesink location=/no/such/folder/file');
    const [failure] = await failures.atLeast(2);
    expect(failure).toMatchObject({ reason: 'device-lost', retried: true });
    expect(device.starts).toBeGreaterThanOrEqual(2);
  });
});
