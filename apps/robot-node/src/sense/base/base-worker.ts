/** The simulated base's thread. It stops the wheels by itself when the main thread hangs. */
import { parentPort, workerData } from 'node:worker_threads';
import { ModelTopic, numbersOf, type TopicReading } from '@farpoint/ros';
import {
  componentStates,
  earthPlace,
  officeWorld,
  SIM_WHEEL_JOINTS,
  SimulatedBase,
  withThings,
} from '@farpoint/sim';
import { EvenPace } from '@farpoint/timing';
import { monotonicMs } from '../../ground/clock.ts';
import { ReadingTopic } from '../../ground/ros/reading-topic.ts';
import type { BaseReport, BaseRequest, BaseWorkerData } from './base-messages.ts';
import { RealTimeBase } from './real-time-base.ts';
import { SnapshotWriter } from './shared-snapshot.ts';
import { SimNavigation } from './sim-navigation.ts';
import { SIM_DIAGNOSTICS, SIM_FIX, SIM_JOINTS, SIM_MOTORS } from './sim-topics.ts';
import { Wheels } from './wheels.ts';

/**
 * Maximum age of the world that the sensors see. 10 ms instead of 4 leave more of the processor to frames
 * (docs/decisions/2026-11-28-cost-of-a-frame.md).
 */
const ADVANCE_EVERY_MS = 10;
/** The robot is told about every second of them. */
const REPORT_MS = 2 * ADVANCE_EVERY_MS;
/**
 * How often the simulated robot tells of its components and of its joints, ms: ROS' diagnostics come once a
 * second, and joints as often as telemetry (robot-reports.ts).
 */
const COMPONENTS_MS = 1000;
const JOINTS_MS = 50;
/** A receiver with corrections from the ground: centimetres. */
const GNSS = {
  status: { status: 2, service: 1 },
  altitude: 520,
  position_covariance: [0.0004, 0, 0, 0, 0.0004, 0, 0, 0, 0.0016],
  position_covariance_type: 2,
};

const port = parentPort;
if (port === null) throw new Error('base-worker.ts runs as a worker only');
const { watchdogMs, maxLateral, charge, origin, things, navigation, snapshot } = workerData as BaseWorkerData;
const world = withThings(officeWorld(), things ?? []);
const base = new RealTimeBase(new SimulatedBase(world, { maxLateralSpeed: maxLateral ?? 0 }, charge));
const navigator = navigation === undefined ? null : new SimNavigation(world, navigation);
const wheels = new Wheels(base, watchdogMs);
const writer = new SnapshotWriter(snapshot);
const diagnostics = new ReadingTopic(SIM_DIAGNOSTICS);
const fix = origin === null ? null : new ReadingTopic(SIM_FIX);
const joints = new ModelTopic(SIM_JOINTS);
const reports = new EvenPace();
let toldComponentsMs = Number.NEGATIVE_INFINITY;
let toldJointsMs = Number.NEGATIVE_INFINITY;

function advance(): void {
  const now = monotonicMs();
  wheels.advance(now);
  writer.write(base.simulated.snapshot);
  if (!reports.takes(now, REPORT_MS)) return;
  reports.taken(now, REPORT_MS);
  const report: BaseReport = { state: { ...base.state, timeMs: now }, watchdogStops: wheels.stops };
  const told: (TopicReading | null)[] = [];
  if (now - toldJointsMs >= JOINTS_MS) {
    toldJointsMs = now;
    told.push(wheelJoints(now));
  }
  if (now - toldComponentsMs >= COMPONENTS_MS) {
    toldComponentsMs = now;
    const { state } = base.simulated;
    const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: '' };
    const { x, y } = state.pose.position;
    told.push(
      diagnostics.take({ header, status: componentStates(state) }, now),
      origin === null ? null : (fix?.take({ ...GNSS, header, ...earthPlace(origin, x, y) }, now) ?? null),
      ...(navigator?.readings(state.pose, now) ?? []),
    );
    report.motors = numbersOf(SIM_MOTORS, state.motorCelsius);
  }
  const readings = told.filter((reading) => reading !== null);
  if (readings.length > 0) report.readings = readings;
  port?.postMessage(report);
}

function wheelJoints(nowMs: number): TopicReading | null {
  const { left, right } = base.simulated.state.wheelAngles;
  const name = [SIM_WHEEL_JOINTS.left, SIM_WHEEL_JOINTS.right];
  return joints.take({ name, position: [left, right] }, nowMs);
}

advance();
const advancing = setInterval(advance, ADVANCE_EVERY_MS);
port.on('message', (request: BaseRequest) => {
  if (request.type === 'twist') {
    wheels.apply(request.twist, monotonicMs());
    return;
  }
  clearInterval(advancing);
  port.close();
});
