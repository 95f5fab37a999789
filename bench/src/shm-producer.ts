/**
 * A depth camera's producer for `pnpm bench shm`: one image of the simulated office at a constant rate, each frame in
 * a single colour of its own, or with --scene in the scene's colours. It records when it began to write each frame,
 * and writes the records to a file when it is told to end.
 */
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import {
  bytesOfPoints,
  POINTS_PER_PACKET,
  unpackBlue664,
  unpackGreen664,
  unpackRed664,
  writePoints64Block,
} from '@farpoint/protocol';
import { CloudProducer, ReferenceFrameProducer } from '@farpoint/shared-memory';
import { Simulation } from '@farpoint/sim';

const { values } = parseArgs({
  options: {
    layout: { type: 'string', default: 'farpoint' },
    folder: { type: 'string', default: '/dev/shm' },
    size: { type: 'string', default: '480' },
    fps: { type: 'string', default: '30' },
    log: { type: 'string' },
    scene: { type: 'boolean' },
  },
});
const size = Number(values.size);
const intervalMs = 1000 / Number(values.fps);
const simulation = await Simulation.create({ seed: 1, camera: { width: size, height: size } });
const scene = simulation.renderFrame();
const count = size * size;
const begun: number[] = [];
const publish = values.layout === 'reference' ? referencePublisher() : farpointPublisher();

process.once('SIGTERM', () => {
  if (values.log !== undefined) writeFileSync(values.log, begun.map((ms) => ms.toFixed(4)).join('\n'));
  process.exit(0);
});

let beatMs = nowMs();
let frame = 0;
beat();

function beat(): void {
  if (publish(frame)) frame++;
  beatMs = Math.max(beatMs + intervalMs, nowMs());
  setTimeout(beat, Math.max(0, beatMs - nowMs()));
}

function nowMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}

function farpointPublisher(): (frame: number) => boolean {
  const producer = new CloudProducer({
    folder: values.folder,
    format: 'points',
    maxPoints: count,
    framesPerSecond: 1000 / intervalMs,
  });
  const words = new Uint32Array(scene.points.buffer, scene.points.byteOffset, count * 4).slice();
  const { fx, fy, cx, cy } = simulation.intrinsics;
  const header = {
    width: size,
    height: size,
    pose: scene.cameraPose,
    lens: { fx, fy, cx, cy },
    latencyTest: false,
  };
  return (frame) => {
    const mark = frame & 0xffff;
    const colour =
      unpackRed664(mark) | (unpackGreen664(mark) << 8) | (unpackBlue664(mark) << 16) | 0xff000000;
    if (values.scene !== true) for (let i = 3; i < words.length; i += 4) words[i] = colour;
    const capturedAtMs = nowMs();
    begun.push(capturedAtMs);
    producer.publish({ points: words }, { ...header, capturedAtMs });
    return true;
  };
}

function referencePublisher(): (frame: number) => boolean {
  const producer = new ReferenceFrameProducer(values.folder);
  const packed = pack();
  return (frame) => {
    // Like the reference system's producer: makes nothing before the last frame was taken.
    if (!producer.free) return false;
    const values16 = new Uint16Array(packed.buffer);
    for (let block = 0; block < values16.length; block += POINTS_PER_PACKET * 4)
      values16.fill(frame & 0xffff, block + POINTS_PER_PACKET * 3, block + POINTS_PER_PACKET * 4);
    begun.push(nowMs());
    return producer.publish(packed);
  };
}

/** The points of the scene that can be sent, repeated until there are as many as the camera has pixels. */
function pack(): Uint8Array {
  const valid: number[] = [];
  for (let i = 0; i < count; i++) if ((scene.points[i * 4 + 2] as number) > 0) valid.push(i);
  const positions = new Float32Array(count * 3);
  for (let i = 0; i < count; i++) {
    const from = (valid[i % valid.length] as number) * 4;
    positions.set(scene.points.subarray(from, from + 3), i * 3);
  }
  const packed = new Uint8Array(bytesOfPoints(count));
  const view = new DataView(packed.buffer);
  const colours = new Uint16Array(count);
  for (let first = 0; first < count; first += POINTS_PER_PACKET) {
    const points = Math.min(POINTS_PER_PACKET, count - first);
    writePoints64Block(view, bytesOfPoints(first), positions, colours, first, points);
  }
  return packed;
}
