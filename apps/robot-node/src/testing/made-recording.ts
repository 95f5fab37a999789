/** A recording as the robot writes them, made at once: what it contains is known, and nobody has to wait for it. */
import { PictureCodec } from '@farpoint/pictures';
import { CloudTap, SessionRecorder } from '@farpoint/recording';

export const SIDE = 64;
/** Clouds, ten a second. */
const CLOUDS = 30;
const EVERY_MS = 100;
/** Of the robot all along, m/s. */
export const SPEED = 0.5;

const QUANTITIES = [
  { topic: '/motors', field: 'left', label: 'Left motor', unit: '°C' },
  { topic: '/motors', field: 'right', label: 'Right motor', unit: '°C' },
];
const CHARGE = { watches: 'charge', label: 'Battery' };
const REPORTS = (['ok', 'ok', 'warn', 'ok'] as const).map((level, i) => ({
  ...{ name: `part ${i}`, level, message: '', sinceMs: 0 },
}));
/** Of the left motor's samples, °C. */
export const valueOfSample = (k: number): number => 20 + k / 8;

/** Clouds and pictures of a camera, the robot's motion, two quantities, an alarm and the reports of four components. */
export async function makeRecording(path: string): Promise<void> {
  const recorder = await SessionRecorder.open({
    ...{ path, compression: 'none', robotId: 'recorded', epochNs: 1_700_000_000_000_000_000n },
  });
  recorder.cameras([{ name: 'Camera', ofCloud: true }]);
  recorder.telemetry(QUANTITIES, [CHARGE]);
  recorder.diagnostics('/diagnostics', 0, REPORTS);
  recorder.alarm(0, 0, {
    ...{ level: 'warn', text: 'The battery is low', value: 15, limit: 20, unit: '%', sinceMs: 0 },
  });
  const codec = await PictureCodec.load();
  // Each picture is another one.
  const pictureOf = (k: number) =>
    codec.encodeJpeg(
      { width: SIDE, height: SIDE, rgba: new Uint8Array(SIDE * SIDE * 4).fill(99 + 2 * k) },
      80,
    );
  const tap = new CloudTap(recorder.clouds, { captured: 1000, sent: 0 });
  const [depth, colour] = [new Float32Array(SIDE ** 2).fill(2), new Uint32Array(SIDE ** 2).fill(0xff03_0201)];
  const lens = { fx: SIDE, fy: SIDE, cx: SIDE / 2, cy: SIDE / 2 };
  const level = { x: 0, y: 0, z: 0, w: 1 };
  for (let k = 0; k < CLOUDS; k++) {
    const timeMs = k * EVERY_MS;
    const x = (SPEED * timeMs) / 1000;
    const cameraPose = { position: { x, y: 0, z: 1 }, orientation: { x: -0.5, y: 0.5, z: -0.5, w: 0.5 } };
    const cloud = { form: 'images' as const, depth, colour, cameraPose, capturedAtMs: timeMs };
    tap.captured(cloud, { width: SIDE, height: SIDE, camera: lens });
    recorder.picture(0, timeMs, 'jpeg', pictureOf(k));
    const still = { x: 0, y: 0, z: 0 };
    recorder.state(
      timeMs,
      { position: { x, y: 0, z: 0 }, orientation: level },
      { linear: { ...still, x: SPEED }, angular: still },
    );
    recorder.json('telemetry', timeMs, { drive: 'driving' });
    for (const number of QUANTITIES.keys()) recorder.sample(number, timeMs, valueOfSample(k) + number * 100);
    while (tap.pending > 0) await new Promise((resolve) => setTimeout(resolve, 1));
  }
  tap.close();
  await recorder.close();
  if (recorder.faults > 0 || recorder.dropped.captured > 0) throw new Error('not all was recorded');
}
