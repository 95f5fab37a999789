/** The thread that hears the guard's topics: laser scans, and what another program demands. */
import { parentPort, workerData } from 'node:worker_threads';
import { decoderOf, RosFault, type RosGraph, SENSOR_QOS } from '@farpoint/ros';
import { PoseTrack } from '@farpoint/safety';
import { monotonicMs } from '../../ground/clock.ts';
import { openGraph } from '../../ground/ros/open-graph.ts';
import { wallNs } from '../../ground/wall-clock.ts';
import { type Placing, ScanGuard } from '../../sense/obstacles/scan-guard.ts';
import { SensorFrames } from '../../sense/obstacles/sensor-frames.ts';
import { SinkBeat } from '../drive/sink-beat.ts';
import { CollisionCells } from './collision-cells.ts';
import {
  COLLISION_TYPES,
  demandedMps,
  type GuardTopicsReport,
  type GuardTopicsRequest,
  type GuardTopicsSetup,
} from './guard-topics-messages.ts';

const LASER_SCAN = 'sensor_msgs/msg/LaserScan';
/** How often the thread says that it lives, ms: 50 times before it is replaced (guard-topics.ts). */
const BEAT_MS = 20;
const CLOCK = { now: monotonicMs, wallNs };

const port = parentPort;
if (port === null) throw new Error('guard-topics-worker.ts runs as a worker only');
const setup = workerData as GuardTopicsSetup;
const beat = new SinkBeat(setup.beat);
const send = (report: GuardTopicsReport) => port.postMessage(report);
const poses = new PoseTrack();

let lastFault = '';
function tellFault({ message }: Error): void {
  // Report a fault once, not at every message.
  if (message !== lastFault) send({ type: 'fault', detail: message });
  lastFault = message;
}

function hearScans(
  graph: RosGraph,
  { topic, guard }: GuardTopicsSetup['scans'][number],
  placing: Placing | undefined,
): void {
  const decode = decoderOf(graph.version, LASER_SCAN, null);
  const scans = new ScanGuard(guard, poses, CLOCK, placing);
  graph.subscribe({ topic, type: LASER_SCAN, qos: SENSOR_QOS, queue: 1 }, (bytes, receivedMs) => {
    try {
      scans.take(decode(bytes), receivedMs);
    } catch (error) {
      tellFault(RosFault.of(error, topic));
    }
  });
}

/** @returns looks whether anybody publishes */
function hearDemands(
  graph: RosGraph,
  { topic, type, cells: memory }: NonNullable<GuardTopicsSetup['collision']>,
): () => void {
  const cells = new CollisionCells(memory);
  let before: number | null = null;
  const to = { topic, type: COLLISION_TYPES[type], qos: SENSOR_QOS, queue: 16 };
  const subscription = graph.subscribe(to, (bytes, receivedMs) => {
    const most = demandedMps(type, graph.version, bytes);
    cells.setPublishers(Math.max(1, subscription.publishers));
    cells.hear(most, receivedMs);
    if (most !== before) send({ type: 'changed' });
    before = most;
  });
  return () => cells.setPublishers(subscription.publishers);
}

try {
  const graph = await openGraph(setup.graph, 'guard');
  graph.onFault = tellFault;
  const frames = setup.frames === null ? null : new SensorFrames(graph, setup.frames, CLOCK, tellFault);
  const placing: Placing | undefined =
    frames === null ? undefined : (frameId, atMs) => frames.mountOf(frameId, atMs);
  for (const scan of setup.scans) hearScans(graph, scan, placing);
  const look = setup.collision === null ? null : hearDemands(graph, setup.collision);
  const beating = setInterval(() => {
    look?.();
    beat.beat(monotonicMs());
  }, BEAT_MS);
  port.on('message', (request: GuardTopicsRequest) => {
    if (request.type === 'pose') {
      poses.measured(request.pose, request.twist, request.atMs);
      return;
    }
    clearInterval(beating);
    void graph.close().finally(() => port.close());
  });
} catch (error) {
  send({ type: 'failed', detail: error instanceof Error ? error.message : String(error) });
  port.close();
}
