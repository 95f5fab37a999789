/** Records until it is killed; prints how many messages are written so far, one line each. */
import { CloudTap } from '../cloud-tap.ts';
import { SessionRecorder } from '../session-recorder.ts';

const path = process.argv[2];
if (path === undefined) throw new Error('usage: endless-recorder.ts FILE');
const recorder = await SessionRecorder.open({ path, compression: 'none', robotId: 'endless', epochNs: 0n });
const tap = new CloudTap(recorder.clouds, { captured: 1000, sent: 1000 });
const points = new Float32Array(100 * 100 * 4).fill(1);
const cameraPose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
let k = 0;
setInterval(() => {
  k++;
  tap.captured(
    { form: 'points', points, count: 10_000, cameraPose, capturedAtMs: k * 10 },
    { width: 100, height: 100, camera: null },
  );
  recorder.json('telemetry', k * 10, { k });
  process.stdout.write(`${recorder.file.messages}\n`);
}, 10);
