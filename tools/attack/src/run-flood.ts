import { once } from 'node:events';
import { Worker } from 'node:worker_threads';
import { type Latency, measureLatency } from './drive-latency.ts';
import { type FloodKind, floodKinds } from './flood-datagrams.ts';
import type { FloodOrder } from './flood-worker.ts';
import { LiveDriver } from './live-driver.ts';
import { ROBOT, Scene } from './scene.ts';

export interface FloodOptions {
  /** How long each kind is sent. */
  seconds: number;
  perSecond: number;
  /** Kinds whose name contains it; all if undefined. */
  only?: string | undefined;
}

export interface FloodResult {
  name: string;
  /** As it was sent. */
  perSecond: number;
  before: Latency;
  during: Latency;
  sessionsLost: number;
  /** Resident memory of the robot. */
  bytesBefore: number;
  bytesAfter: number;
  /** `null` if the operator went on driving. */
  harm: string | null;
}

/** A stranger sends datagrams of one kind after the other to the socket at which the robot hears its driver. */
export async function runFlood({ seconds, perSecond, only }: FloodOptions): Promise<FloodResult[]> {
  const results: FloodResult[] = [];
  const kinds = floodKinds.filter(({ name }) => only === undefined || name.includes(only));
  if (kinds.length === 0) return [];
  const scene = await Scene.start();
  try {
    for (const kind of kinds) results.push(await flood(scene, kind, seconds, perSecond));
  } finally {
    await scene.stop();
  }
  return results;
}

async function flood(
  scene: Scene,
  kind: FloodKind,
  seconds: number,
  perSecond: number,
): Promise<FloodResult> {
  const before = await measureLatency(scene.driver, Math.min(seconds, 6));
  const ended = await scene.metric('farpoint_robot_operators');
  const bytesBefore = scene.robotBytes;
  const { connection, robotAddress } = scene.driver;
  const [host, port] = robotAddress;
  const username = `${connection.remoteUsername}:${connection.localUsername}`;
  const order: FloodOrder = { host, port, perSecond, datagrams: kind.datagrams(username) };
  const worker = new Worker(new URL('flood-worker.ts', import.meta.url), { workerData: order });
  await once(worker, 'online');
  const during = await measureLatency(scene.driver, seconds);
  const stopped = once(worker, 'message');
  worker.postMessage('stop');
  const [sent] = (await stopped) as [number];
  await worker.terminate();
  const sessionsLost = Math.max(0, ended - (await scene.metric('farpoint_robot_operators')));
  const bytesAfter = scene.robotBytes;
  const harm = await scene.harm();
  if (harm !== null) {
    await scene.driver.close();
    scene.driver = await LiveDriver.start(scene.stack.signalingUrl, ROBOT);
  }
  return { name: kind.name, perSecond: sent, before, during, sessionsLost, bytesBefore, bytesAfter, harm };
}
