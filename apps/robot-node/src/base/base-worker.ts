/** The simulated base's thread. It stops the wheels by itself when the main thread hangs. */
import { parentPort, workerData } from 'node:worker_threads';
import { numbersOf } from '@farpoint/ros';
import { componentStates, officeWorld, SimulatedBase } from '@farpoint/sim';
import { ReadingTopic } from '../capture/reading-topic.ts';
import { monotonicMs } from '../clock.ts';
import type { BaseReport, BaseRequest, BaseWorkerData } from './base-messages.ts';
import { RealTimeBase } from './real-time-base.ts';
import { SnapshotWriter } from './shared-snapshot.ts';
import { SIM_DIAGNOSTICS, SIM_MOTORS } from './sim-topics.ts';
import { Wheels } from './wheels.ts';

/** Maximum age of the world that the sensors see. */
const TICK_MS = 4;
const REPORT_MS = 20;
const COMPONENTS_MS = 1000;

const port = parentPort;
if (port === null) throw new Error('base-worker.ts runs as a worker only');
const { watchdogMs, charge, snapshot } = workerData as BaseWorkerData;
const base = new RealTimeBase(new SimulatedBase(officeWorld(), {}, charge));
const wheels = new Wheels(base, watchdogMs);
const writer = new SnapshotWriter(snapshot);
const diagnostics = new ReadingTopic(SIM_DIAGNOSTICS);
let reportedMs = Number.NEGATIVE_INFINITY;
let toldComponentsMs = Number.NEGATIVE_INFINITY;

function tick(): void {
  const now = monotonicMs();
  wheels.advance(now);
  writer.write(base.simulated.snapshot);
  if (now - reportedMs < REPORT_MS) return;
  reportedMs = now;
  const report: BaseReport = { state: { ...base.state, timeMs: now }, watchdogStops: wheels.stops };
  if (now - toldComponentsMs >= COMPONENTS_MS) {
    toldComponentsMs = now;
    const { state } = base.simulated;
    const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: '' };
    const components = diagnostics.take({ header, status: componentStates(state) }, now);
    if (components !== null) Object.assign(report, { components });
    report.motors = numbersOf(SIM_MOTORS, state.motorCelsius);
  }
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
