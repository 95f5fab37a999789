/** A thread that publishes until it is terminated. */
import { workerData } from 'node:worker_threads';
import { DdsGraph, type DdsGraphOptions } from '../dds-graph.ts';
import { cdr } from './helpers.ts';

const { options, topic, type } = workerData as { options: DdsGraphOptions; topic: string; type: string };
const publisher = new DdsGraph(options).advertise({ topic, type });
setInterval(() => publisher.publish(cdr(1)), 1);
