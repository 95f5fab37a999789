/**
 * The thread that feeds video cameras: it subscribes to ROS topics and renders simulated cameras, and owns the processes
 * that encode them. Raw pictures, megabytes each, thus stay away from the thread that stops the wheels.
 */
import { parentPort } from 'node:worker_threads';
import { FeedCameras } from './feed-cameras.ts';
import type { FeedRequest } from './feed-messages.ts';

const main = parentPort;
if (main === null) throw new Error('feed-worker.ts runs as a worker only');
const cameras = new FeedCameras((report, transfer = []) => main.postMessage(report, transfer));

main.on('message', (request: FeedRequest) => {
  cameras.onRequest(request);
  // Without its port, the thread ends when all else is closed.
  if (request.type === 'end') main.close();
});
