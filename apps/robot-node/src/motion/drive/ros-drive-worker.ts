/**
 * The thread that publishes velocities. It publishes zero by itself when the main thread hangs, which no timer in the
 * main thread could do.
 */
import { parentPort, workerData } from 'node:worker_threads';
import { monotonicMs } from '../../ground/clock.ts';
import { openGraph } from '../../ground/ros/open-graph.ts';
import { wallNs } from '../../ground/wall-clock.ts';
import type { RosDriveReport, RosDriveRequest, RosDriveSetup } from './ros-drive-messages.ts';
import { RosVelocity } from './ros-velocity.ts';
import { SinkBeat } from './sink-beat.ts';

/**
 * Silence is noticed, and the thread says that it lives, this often, ms: well within the 150 ms of the
 * watchdog.
 */
const CHECK_EVERY_MS = 10;

const port = parentPort;
if (port === null) throw new Error('ros-drive-worker.ts runs as a worker only');
const options = workerData as RosDriveSetup;
const beat = new SinkBeat(options.beat);
const send = (report: RosDriveReport) => port.postMessage(report);

try {
  const graph = await openGraph(options.graph, 'drive');
  let lastFault = '';
  graph.onFault = ({ message }) => {
    // Report a fault once, not at every retry.
    if (message !== lastFault) send({ type: 'fault', detail: message });
    lastFault = message;
  };
  const { entry, silenceMs } = options;
  const velocity = new RosVelocity(graph, { entry, silenceMs, now: monotonicMs, wallNs });
  let listeners: number | null = null;
  const checking = setInterval(() => {
    velocity.checkSilence();
    beat.beat(monotonicMs());
    if (velocity.subscribers === listeners) return;
    listeners = velocity.subscribers;
    send({ type: 'listeners', count: listeners });
  }, CHECK_EVERY_MS);
  port.on('message', (request: RosDriveRequest) => {
    if (request.type === 'twist') {
      velocity.apply(request.twist, request.hold);
      return;
    }
    clearInterval(checking);
    velocity.close();
    void graph.close().finally(() => port.close());
  });
} catch (error) {
  send({ type: 'failed', detail: error instanceof Error ? error.message : String(error) });
  port.close();
}
