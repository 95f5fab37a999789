/**
 * A strict stand-in for the thread that publishes velocities: it speaks the same messages and gives the same signs of
 * life, and fails on command. What it would have published goes to the broadcast channel `drive-worker`.
 */
import { BroadcastChannel, parentPort, workerData } from 'node:worker_threads';
import { monotonicMs } from '../ground/clock.ts';
import type { RosDriveReport, RosDriveRequest, RosDriveSetup } from '../motion/drive/ros-drive-messages.ts';
import { SinkBeat } from '../motion/drive/sink-beat.ts';

const port = parentPort;
if (port === null) throw new Error('ending-drive-worker.ts runs as a worker only');
const beat = new SinkBeat((workerData as RosDriveSetup).beat);
const wire = new BroadcastChannel('drive-worker');
const tell = (count: number) => port.postMessage({ type: 'listeners', count } satisfies RosDriveReport);

const beating = setInterval(() => beat.beat(monotonicMs()), 10);
beat.beat(monotonicMs());
tell(1);
wire.onmessage = (event) => {
  const { data } = event as unknown as { data: unknown };
  if (data === 'throw') throw new Error('the thread was killed');
  while (data === 'hang');
  if (data === 'leave') tell(0);
  if (data === 'join') tell(1);
};
port.on('message', (request: RosDriveRequest) => {
  if (request.type === 'twist') {
    wire.postMessage({ x: request.twist.linear.x, hold: request.hold });
    return;
  }
  clearInterval(beating);
  wire.close();
  port.close();
});
