import { DdsGraph } from '@farpoint/dds';
import { LATCHED_QOS, type Publisher, type Subscription } from '@farpoint/ros';
import { messageBytes } from '@farpoint/ros/testing';
import { monotonicMs } from '../ground/clock.ts';

const STEP_MS = 10;
const ODOMETRY_STEPS = 2;
const CLOUD_STEPS = 8;
/** Wheels that are told nothing for longer stand, ms. */
const WATCHDOG_MS = 300;
/** Of the sensor over the floor, m. */
const SENSOR_Z = 1;
const REACH_M = 1.6;
const CELL_M = 0.04;
const POINT_BYTES = 16;

const header = (frame_id: string) => {
  const now = Date.now();
  return { stamp: { sec: Math.floor(now / 1000), nanosec: (now % 1000) * 1_000_000 }, frame_id };
};
const NO_TURN = { x: 0, y: 0, z: 0, w: 1 };

/**
 * A robot in a ROS 2 graph that drives straight on, with odometry and a sensor that sees the floor all around, and what
 * stands there: topics `/points`, `/odom`, `/tf_static` and `/cmd_vel`.
 */
export class Ros2Base {
  /** In the world, m. */
  x = 0;
  /** Of the last velocity that it was told, m/s. */
  speed = 0;
  /** How many it has published. */
  clouds = 0;
  /** Where somebody stands before or behind it: from x to x, m; `null` for nowhere. */
  person: readonly [number, number] | null = null;
  /** The lowest velocity that it was ever told, m/s. */
  lowest = 0;
  readonly graph: DdsGraph;
  readonly #publishers: Record<'points' | 'odom' | 'tf', Publisher>;
  readonly #wheels: Subscription;
  readonly #timer: NodeJS.Timeout;
  #toldMs = 0;
  #atMs = monotonicMs();
  #steps = 0;

  constructor(domain: number) {
    this.graph = new DdsGraph({ domain, localhostOnly: true, now: monotonicMs });
    const { graph } = this;
    this.#publishers = {
      points: graph.advertise({ topic: '/points', type: 'sensor_msgs/msg/PointCloud2' }),
      odom: graph.advertise({ topic: '/odom', type: 'nav_msgs/msg/Odometry' }),
      tf: graph.advertise({ topic: '/tf_static', type: 'tf2_msgs/msg/TFMessage', qos: LATCHED_QOS }),
    };
    const sensor = { translation: { x: 0, y: 0, z: SENSOR_Z }, rotation: NO_TURN };
    const transforms = [{ header: header('base_link'), child_frame_id: 'lidar', transform: sensor }];
    this.#publishers.tf.publish(messageBytes(2, 'tf2_msgs/msg/TFMessage', { transforms }));
    this.#wheels = graph.subscribe(
      { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', queue: 4 },
      (bytes) => {
        // After CDR's encapsulation: linear.x.
        this.speed = new DataView(bytes.buffer, bytes.byteOffset).getFloat64(4, true);
        this.lowest = Math.min(this.lowest, this.speed);
        this.#toldMs = monotonicMs();
      },
    );
    this.#timer = setInterval(() => this.#step(), STEP_MS);
  }

  async close(): Promise<void> {
    clearInterval(this.#timer);
    this.#wheels.close();
    await this.graph.close();
  }

  #step(): void {
    const now = monotonicMs();
    if (now - this.#toldMs > WATCHDOG_MS) this.speed = 0;
    this.x += (this.speed * (now - this.#atMs)) / 1000;
    this.#atMs = now;
    this.#steps++;
    if (this.#steps % ODOMETRY_STEPS === 0) this.#publishOdometry();
    if (this.#steps % CLOUD_STEPS === 0) this.#publishCloud();
  }

  #publishOdometry(): void {
    const covariance = new Array<number>(36).fill(0);
    const zero = { x: 0, y: 0, z: 0 };
    const message = {
      header: header('odom'),
      child_frame_id: 'base_link',
      pose: { pose: { position: { x: this.x, y: 0, z: 0 }, orientation: NO_TURN }, covariance },
      twist: { twist: { linear: { ...zero, x: this.speed }, angular: zero }, covariance },
    };
    this.#publishers.odom.publish(messageBytes(2, 'nav_msgs/msg/Odometry', message));
  }

  #publishCloud(): void {
    const points: number[] = [];
    for (let x = -REACH_M; x < REACH_M; x += CELL_M)
      for (let y = -0.8; y < 0.8; y += CELL_M) points.push(x, y, -SENSOR_Z, 0);
    if (this.person !== null) {
      const [near, far] = this.person;
      for (let x = near - this.x; x <= far - this.x; x += CELL_M)
        for (let y = -0.2; y <= 0.2; y += CELL_M)
          for (let z = 0.1; z < 1.1; z += CELL_M) points.push(x, y, z - SENSOR_Z, 0);
    }
    const data = new Uint8Array(Float32Array.from(points).buffer);
    const count = data.length / POINT_BYTES;
    const field = (name: string, offset: number) => ({ name, offset, datatype: 7, count: 1 });
    const message = {
      ...{ header: header('lidar'), height: 1, width: count },
      fields: [field('x', 0), field('y', 4), field('z', 8)],
      ...{ is_bigendian: false, point_step: POINT_BYTES, row_step: data.length, data, is_dense: true },
    };
    this.clouds++;
    this.#publishers.points.publish(messageBytes(2, 'sensor_msgs/msg/PointCloud2', message));
  }
}
