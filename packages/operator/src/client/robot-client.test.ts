import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { BATCH_BYTES, type Batch } from '../cloud/batch.ts';
import type { FromCloudWorker, ToCloudWorker } from '../cloud/worker-messages.ts';
import type { RobotLink, RobotLinkEvents } from '../link/robot-link.ts';
import { RobotClient } from './robot-client.ts';

/** Stands in for the cloud worker. */
class WorkerStub {
  static last: WorkerStub;
  onmessage: ((event: { data: FromCloudWorker }) => void) | null = null;
  readonly told: ToCloudWorker[] = [];
  ended = false;

  constructor() {
    WorkerStub.last = this;
  }
  postMessage(message: ToCloudWorker): void {
    this.told.push(message);
  }
  terminate(): void {
    this.ended = true;
  }
  say(message: FromCloudWorker): void {
    this.onmessage?.({ data: message });
  }
}

beforeEach(() => vi.stubGlobal('Worker', WorkerStub));
afterEach(() => vi.unstubAllGlobals());

function bench(): { client: RobotClient; worker: WorkerStub } {
  const options = { signalingUrl: 'wss://x.org/operator', name: 'Operator', token: undefined } as const;
  const client = new RobotClient({ ...options, icePolicy: 'all', transform: 'script-transform' });
  return { client, worker: WorkerStub.last };
}
/** Points of a session. No session has begun, and the receiver counts from 0. */
const batch = (generation: number, sensor = 0): FromCloudWorker => ({
  ...{ type: 'batch', generation, sensor, packets: 0, points: 0 },
  buffer: new ArrayBuffer(BATCH_BYTES),
});

describe('RobotClient', () => {
  test('points without a listener go back to the worker, as do those of an earlier session', () => {
    const { client, worker } = bench();
    worker.say(batch(0));
    expect(worker.told.map(({ type }) => type)).toEqual(['return']);
    const taken: Batch[] = [];
    client.on('cloud', (points) => taken.push(points));
    worker.say(batch(0));
    expect(taken).toHaveLength(1);
    expect(worker.told).toHaveLength(1);
    worker.say(batch(7));
    expect(taken).toHaveLength(1);
    expect(worker.told).toHaveLength(2);
    client.release(taken[0] as Batch);
    expect(worker.told).toHaveLength(3);
  });

  test('points of each sensor go to its listener, or back if there is none', () => {
    const { client, worker } = bench();
    const taken: [string, number][] = [];
    client.on('cloud', ({ sensor }) => taken.push(['first', sensor]));
    client.on('cloud:1', ({ sensor }) => taken.push(['second', sensor]));
    for (const sensor of [0, 1, 2]) worker.say(batch(0, sensor));
    expect(taken).toEqual([
      ['first', 0],
      ['second', 1],
    ]);
    expect(worker.told.map(({ type }) => type)).toEqual(['return']);
  });

  test('reports that the decoder cannot be loaded', () => {
    const { client, worker } = bench();
    const failed: unknown[] = [];
    client.on('failed', (failure) => failed.push(failure));
    worker.say({ type: 'failed', message: 'no WASM' });
    expect(failed).toEqual([{ reason: 'cloud-worker', detail: 'no WASM' }]);
  });

  test('waits for the chosen robot', () => {
    const { client } = bench();
    const phases: string[] = [];
    client.on('phase', (phase) => phases.push(phase));
    client.choose('rover-1');
    expect(client.chosenRobotId).toBe('rover-1');
    client.leave();
    expect(client.chosenRobotId).toBe(null);
    expect(phases).toEqual(['waiting', 'none']);
  });

  test('who leaves a robot gives the lease back first', () => {
    const sent: string[] = [];
    const link = {
      ...{ phase: 'live', robotId: 'rover-1', interrupted: false, robots: [] },
      sendCommand: () => sent.push('command'),
      sendSession: ({ type }: { type: string }) => sent.push(type),
      disconnect: () => sent.push('disconnect'),
    } as unknown as RobotLink;
    let events: RobotLinkEvents | undefined;
    const client = new RobotClient({
      ...{ signalingUrl: 'wss://x.org/operator', name: 'Operator', token: undefined, icePolicy: 'all' },
      transform: 'script-transform',
      openLink: (_, told) => {
        events = told;
        return link;
      },
    });
    events?.onLease({ type: 'lease', holder: 'you', lease: 'x' });
    client.leave();
    expect(sent).toEqual(['leaseRelease', 'disconnect']);
  });

  test('a wish that is not renewed expires', () => {
    const { client } = bench();
    client.drive({ forward: 1, left: 0 });
    expect(client.driver.input?.wish.forward).toBe(1);
    client.update(performance.now() + 1000);
    expect(client.driver.input).toBe(null);
    client.drive({ forward: 1, left: 0 });
    client.stop();
    expect(client.driver.input).toBe(null);
  });

  test('without a session an emergency stop, its release or the end of a session is not sent, and the caller is told', () => {
    const { client } = bench();
    expect(client.endSession(3)).toBe(false);
    expect(client.estop()).toBe(false);
    expect(client.releaseEstop()).toBe(false);
  });

  test('closing ends the worker, and a closed client connects to no robot', () => {
    const { client, worker } = bench();
    client.close();
    expect(worker.ended).toBe(true);
    client.choose('rover-1');
    expect(client.chosenRobotId).toBe(null);
  });
});
