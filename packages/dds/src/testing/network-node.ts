/**
 * A program with a graph. `publish` sends messages of a cloud's size ten times per second until it is killed. `hear`
 * exits with 0 after ten of them, and with 3 if none arrives within the given time: network-node.ts ROLE DOMAIN MS
 * OPTIONS
 */
import { RELIABLE_QOS } from '@farpoint/ros';
import { DdsGraph } from '../dds-graph.ts';
import { cdr } from './helpers.ts';

const MESSAGE_BYTES = 3_700_000;
const [role, domain, ms, options] = process.argv.slice(2) as [string, string, string, string];
const graph = new DdsGraph({ ...JSON.parse(options), domain: Number(domain) });
const topic = { topic: '/points', type: 'sensor_msgs/msg/PointCloud2', qos: RELIABLE_QOS };

if (role === 'publish') {
  const publisher = graph.advertise(topic);
  const bytes = new Uint8Array(MESSAGE_BYTES);
  bytes.set(cdr());
  setInterval(() => publisher.publish(bytes), 100);
} else {
  let heard = 0;
  graph.subscribe({ ...topic, queue: 5 }, (bytes) => {
    if (bytes.length === MESSAGE_BYTES && ++heard === 10) process.exit(0);
  });
  setTimeout(() => process.exit(heard === 0 ? 3 : 4), Number(ms));
}
