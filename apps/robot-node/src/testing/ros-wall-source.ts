/** A robot's ROS graph for drives at a wall: odometry, tf and clouds as they really are, or otherwise. */

import type { Pose } from '@farpoint/protocol';
import { type RosGraph, topicTableSchema } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import { RosSource } from '../sense/sources/ros-source.ts';
import { bodyMount, opticalMount, type SensorMount } from '../sense/sources/sensor-mount.ts';
import { BEGAN_MS, EARTH, type WallTruth } from './wall-drive.ts';

export const CLOUD = 'sensor_msgs/msg/PointCloud2';
export const ODOMETRY = 'nav_msgs/msg/Odometry';
export const TF = 'tf2_msgs/msg/TFMessage';
export const POSE = 'geometry_msgs/msg/PoseStamped';
export const FIX = 'sensor_msgs/msg/NavSatFix';
const WALL_S = 1_700_000_000;
const NO_TURN = { x: 0, y: 0, z: 0, w: 1 };

/** @param ms of the robot's clock, which began at the wall clock's `WALL_S` */
export function headerAt(ms: number, frame_id: string) {
  const since = ms - BEGAN_MS;
  const second = Math.floor(since / 1000);
  return { stamp: { sec: WALL_S + second, nanosec: Math.round((since - second * 1000) * 1e6) }, frame_id };
}

export function cloudAt(ms: number, points: Float32Array, frame = 'lidar') {
  const width = points.length / 3;
  return {
    header: headerAt(ms, frame),
    ...{ width, height: 1, point_step: 12, row_step: width * 12, is_bigendian: false, is_dense: true },
    fields: ['x', 'y', 'z'].map((name, i) => ({ name, offset: i * 4, datatype: 7, count: 1 })),
    data: new Uint8Array(points.buffer, points.byteOffset, points.byteLength),
  };
}

export function odometryAt(ms: number, x: number, { twist }: Pick<WallTruth, 'twist'>, child = 'base_link') {
  const covariance = new Array<number>(36).fill(0);
  return {
    header: headerAt(ms, 'odom'),
    child_frame_id: child,
    pose: { pose: { position: { x, y: 0, z: 0 }, orientation: NO_TURN }, covariance },
    twist: { twist, covariance },
  };
}

export function transformAt(ms: number, parent: string, child: string, { position, orientation }: Pose) {
  return {
    header: headerAt(ms, parent),
    child_frame_id: child,
    transform: { translation: position, rotation: orientation },
  };
}

export function poseAt(ms: number, x: number) {
  return { header: headerAt(ms, 'map'), pose: { position: { x, y: 0, z: 0 }, orientation: NO_TURN } };
}

/** What a satellite receiver says of a robot that has gone so far to the east. */
export function fixAt(ms: number, x: number) {
  const { latitude, longitude } = EARTH.origin;
  const metresPerDegree = EARTH.toFrame(latitude, longitude + 0.001)[0] * 1000;
  return {
    header: headerAt(ms, 'gps'),
    status: { status: 0, service: 1 },
    ...{ latitude, longitude: longitude + x / metresPerDegree, altitude: 500 },
    ...{ position_covariance: new Array<number>(9).fill(0), position_covariance_type: 0 },
  };
}

/** Where the sensor sits, as tf says it. */
export function mountTransform(mount: SensorMount, child = 'lidar') {
  return transformAt(BEGAN_MS, 'base_link', child, bodyMount(mount));
}

export interface RosWall {
  graph: MemoryGraph;
  source: RosSource;
  faults: string[];
  setNow(nowMs: number): void;
}

/** A source with these topics. @param mount as configured; `null`: not */
export async function rosWall(
  table: unknown,
  mount: SensorMount | null,
  axes: 'auto' | 'body' = 'auto',
): Promise<RosWall> {
  let nowMs = BEGAN_MS;
  const graph = new MemoryGraph(2, () => nowMs);
  const clock = {
    now: () => nowMs,
    wallNs: () => BigInt(WALL_S) * 1_000_000_000n + BigInt(Math.round((nowMs - BEGAN_MS) * 1e6)),
  };
  const configured = mount === null ? null : opticalMount(mount);
  const options = { topics: topicTableSchema.parse(table), axes, waitMs: 1000, mount: configured };
  const opening = RosSource.open(graph as RosGraph, options, clock);
  graph.say('/points', CLOUD, cloudAt(BEGAN_MS - 1000, new Float32Array(60_000)));
  const source = await opening;
  const faults: string[] = [];
  source.onFault = ({ message }) => faults.push(message);
  source.start();
  source.skip();
  return {
    ...{ graph, source, faults },
    setNow: (ms) => {
      nowMs = ms;
    },
  };
}
