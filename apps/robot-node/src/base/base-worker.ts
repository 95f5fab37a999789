/** The simulated base's thread. It stops the wheels by itself when the main thread hangs. */
import { parentPort, workerData } from 'node:worker_threads';
import { officeWorld, SimulatedBase } from '@farpoint/sim';
import { monotonicMs } from '../clock.ts';
import type { BaseReport, BaseRequest, BaseWorkerData } from './base-messages.ts';
import { RealTimeBase } from './real-time-base.ts';
import { SnapshotWriter } from './shared-snapshot.ts';
import { Wheels } from './wheels.ts';

/** Maximum age of the world that the sensors see. */
const TICK_MS = 4;
const REPORT_MS = 20;

const port = parentPort;
if (port === null) throw new Error('base-worker.ts runs as a worker only');
const { watchdogMs, snapshot } = workerData as BaseWorkerData;
const base = new RealTimeBase(new SimulatedBase(officeWorld()));
const wheels = new Wheels(base, watchdogMs);
const writer = new SnapshotWriter(snapshot);
let reportedMs = Number.NEGATIVE_INFINITY;

function tick(): void {
  const now = monotonicMs();
  wheels.advance(now);
  writer.write(base.simulated.snapshot);
  if (now - reportedMs < REPORT_MS) return;
  reportedMs = now;
  const report: BaseReport = { state: { ...base.state, timeMs: now }, watchdogStops: wheels.stops };
  port?.postMessage(report);
}

tick();
const ticking = setInterval(tick, TICK_MS);
port.on('message', (request: BaseRequest) => {
  if (request.type === 'twist') {
    wheels.apply(request.twist, monotonicMs());
    return;
  }
  clearInterval(ticking);
  port.close();
});
