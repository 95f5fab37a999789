/** The thread that publishes goals in the robot's ROS graph, and hears the velocities of the navigator that takes them. */
import { parentPort, workerData } from 'node:worker_threads';
import { GOAL_POSE_TYPE, goalPoseWriter, VELOCITY_QOS, velocityReader } from '@farpoint/ros';
import { openGraph } from '../ros/open-graph.ts';
import { tellNewFaults } from '../ros/tell-new-faults.ts';
import { wallNs } from '../ros/wall-clock.ts';
import type { GoalWorkerReport, GoalWorkerRequest, GoalWorkerSetup } from './goal-messages.ts';

const port = parentPort;
if (port === null) throw new Error('goal-worker.ts runs as a worker only');
const { graph: options, goalTopic, frame, velocityTopic, velocityType } = workerData as GoalWorkerSetup;
const send = (report: GoalWorkerReport) => port.postMessage(report);

try {
  const graph = await openGraph(options, 'goals');
  tellNewFaults(graph, (detail) => send({ type: 'fault', detail }));
  const write = goalPoseWriter(graph.version);
  const read = velocityReader(graph.version, velocityType);
  const publisher = graph.advertise({ topic: goalTopic, type: GOAL_POSE_TYPE });
  const to = { topic: velocityTopic, type: velocityType, qos: VELOCITY_QOS, queue: 1 };
  const subscription = graph.subscribe(to, (bytes, receivedMs) =>
    send({ type: 'velocity', twist: read(bytes), receivedMs }),
  );
  port.on('message', (request: GoalWorkerRequest) => {
    if (request.type === 'goal') {
      if (publisher.subscribers === 0) send({ type: 'fault', detail: `nothing subscribes to ${goalTopic}` });
      publisher.publish(write(request.goal, wallNs(), frame));
      return;
    }
    subscription.close();
    publisher.close();
    void graph.close().finally(() => port.close());
  });
} catch (error) {
  send({ type: 'fault', detail: error instanceof Error ? error.message : String(error) });
  port.close();
}
