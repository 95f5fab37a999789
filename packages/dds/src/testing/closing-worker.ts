/** A thread that opens a graph, closes it, and ends. */
import { DdsGraph } from '../dds-graph.ts';
import { testDomain } from './helpers.ts';

const graph = new DdsGraph({ domain: testDomain(), localhostOnly: true, env: {} });
graph.advertise({ topic: '/a', type: 'std_msgs/msg/String' });
await graph.close();
