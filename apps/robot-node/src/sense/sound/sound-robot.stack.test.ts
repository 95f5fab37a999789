/** The real robot program with a microphone and a loudspeaker. */

import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Sound } from '@farpoint/protocol';
import { useFolder } from '@farpoint/service/testing/folder';
import { Microphone, opusDurationMs } from '@farpoint/sound';
import { ADDON_FILE, BUILD_REMEDY } from '@farpoint/sound/build';
import { samplesOf, toneShare } from '@farpoint/sound/testing';
import { describe, expect, it, onTestFinished } from 'vitest';
import { metricOf } from '../../testing/metric-of.ts';
import type { OperatorClient } from '../../testing/operator-client.ts';
import { useRobot } from '../../testing/use-robot.ts';

const folder = useFolder();
const config = join(folder, 'farpoint.yaml');
const heard = join(folder, 'heard.raw');
const sink = `audio/x-raw,format=S16LE,rate=48000,channels=1 ! filesink location=${heard} buffer-mode=unbuffered`;
writeFileSync(
  config,
  JSON.stringify({
    robot: {
      sound: {
        microphone: { source: { kind: 'test', frequency: 500 } },
        loudspeaker: { sink: { kind: 'gst', pipeline: sink } },
      },
    },
  }),
);

const VOICE_HZ = 700;

/** Speaks until the test ends. @param lost each so many packets, one is lost */
function speak({ sound }: OperatorClient, lost = Number.POSITIVE_INFINITY): Microphone {
  let count = 0;
  let step = 1;
  const speaker = new Microphone({
    ...{ source: { kind: 'test', frequency: VOICE_HZ }, bitsPerS: 32_000, onFailure: () => undefined },
    onPacket: ({ bytes }) => {
      count++;
      if (count % lost === 0) step++;
      else {
        sound.speak(bytes, step);
        step = 1;
      }
    },
  });
  onTestFinished(() => speaker.close());
  return speaker;
}

const bytesHeard = () => (existsSync(heard) ? readFileSync(heard) : Buffer.alloc(0));
/** Resolves once so many bytes more have been played. */
async function hears(client: OperatorClient, more: number): Promise<Buffer> {
  const from = bytesHeard().length;
  // Telemetry comes 20 times a second.
  await client.until(() => bytesHeard().length >= from + more);
  return bytesHeard().subarray(from);
}

/** Resolves when the robot says this of its sound from now on. */
function next(client: OperatorClient, is: (sound: Sound) => boolean): Promise<void> {
  const from = client.session.length;
  return client.until(() =>
    client.session.slice(from).some((message) => message.type === 'sound' && is(message)),
  );
}

describe.skipIf(!existsSync(ADDON_FILE))(`sound (needs: ${BUILD_REMEDY})`, { timeout: 60_000 }, () => {
  const robot = useRobot('sim-1', [
    ...['--config', config, '--sim-size', '64', '--max-points', '600'],
    ...['--rate-control', 'fixed', '--bitrate-mbps', '10'],
  ]);
  const metric = (name: string) => metricOf(robot.stack.robotAdminUrl('sim-1'), `farpoint_robot_${name}`);

  it('is captured only while somebody listens, and reaches everybody who does', async () => {
    const { client } = await robot.connect();
    const first = await client.message('sound');
    expect(first).toMatchObject({ microphone: { state: 'off' }, voice: { state: 'closed' } });
    expect(client.sound.packets).toEqual([]);
    expect(await metric('sound_listeners')).toBe(0);
    const before = await metric('sound_packets_total');
    // Some packets of 20 ms would have been made by the next of these.
    const { sequence } = client.telemetry ?? { sequence: 0 };
    await client.until(() => (client.telemetry?.sequence ?? 0) > sequence + 4);
    expect(await metric('sound_packets_total')).toBe(before);
    client.sendSession({ type: 'listen', on: true });
    await client.message('sound', ({ microphone }) => microphone?.state === 'live');
    const { client: second } = await robot.connect();
    second.sendSession({ type: 'listen', on: true });
    await client.until(() => client.sound.packets.length >= 30);
    await second.until(() => second.sound.packets.length >= 30);
    const packets = client.sound.packets.slice(1, 30);
    for (const { payload } of packets) expect(opusDurationMs(payload)).toBe(20);
    // On a busy machine some are dropped rather than late; those around them keep their place in time.
    const steps = packets.slice(1).map(({ timestamp }, i) => (timestamp - packets[i]!.timestamp) >>> 0);
    for (const step of steps) {
      expect(step).toBeGreaterThanOrEqual(959);
      expect(Math.abs(step - 960 * Math.round(step / 960))).toBeLessThanOrEqual(1);
    }
    const unbroken = packets.slice(1).filter((_, i) => (steps[i] ?? 0) <= 961);
    expect(unbroken.length).toBeGreaterThan(0);
    for (const { marker } of unbroken) expect(marker).toBe(false);
    // Encoded once.
    const own = new Map(client.sound.packets.map(({ timestamp, payload }) => [timestamp, payload]));
    const common = second.sound.packets.filter(({ timestamp }) => own.has(timestamp));
    expect(common.length).toBeGreaterThan(0);
    for (const { timestamp, payload } of common) expect(payload).toEqual(own.get(timestamp));
    for (const each of [client, second]) {
      const told = next(each, ({ microphone }) => microphone?.state === 'off');
      each.sendSession({ type: 'listen', on: false });
      await told;
    }
    expect(await metric('sound_bits_per_second')).toBe(0);
  });

  it('of the driver is played while the key is held, and the driver does not hear itself', async () => {
    const { client } = await robot.connect();
    await client.takeLease();
    client.sendSession({ type: 'listen', on: true });
    await client.message('sound', ({ microphone }) => microphone?.state === 'live');
    speak(client, 10);
    const held = setInterval(() => client.sendSession({ type: 'speak', held: true }), 250);
    client.sendSession({ type: 'speak', held: true });
    await client.message('sound', ({ voice }) => voice?.state === 'open');
    await client.message('sound', ({ microphone }) => microphone?.state === 'muted');
    const played = samplesOf(await hears(client, 60 * 960 * 2));
    expect(toneShare(played.slice(9600), VOICE_HZ, 48_000)).toBeGreaterThan(0.8);
    clearInterval(held);
    const told = next(client, ({ voice }) => voice?.state === 'closed');
    client.sendSession({ type: 'speak', held: false });
    await told;
    // What is sent on without the key is not played.
    let last = { played: bytesHeard().length, sent: client.sound.packets.length };
    await client.until(() => {
      const now = { played: bytesHeard().length, sent: client.sound.packets.length };
      // What was on its way.
      if (now.played > last.played) last = now;
      return now.sent > last.sent + 20;
    });
  });

  it('of an operator who does not drive is not played, and it is told so', async () => {
    const { client } = await robot.connect();
    speak(client);
    client.sendSession({ type: 'speak', held: true });
    const told = await client.message('sound', ({ voice }) => voice?.state === 'not-driving');
    expect(told.voice?.detail).toContain('drives');
    const from = bytesHeard().length;
    await client.until(() => client.completeFrames.length > 10);
    expect(bytesHeard().length).toBe(from);
  });
});
