import { EventEmitter, once } from 'node:events';
import type { ReferenceClientToService, ReferenceRobot } from '@farpoint/protocol';
import { expect, it, onTestFinished } from 'vitest';
import { monotonicMs } from './bridge.ts';
import { RobotRoster } from './robot-roster.ts';

function roster() {
  const sent: ReferenceClientToService[] = [];
  const failures = new EventEmitter();
  const made = new RobotRoster(
    {
      maxRobots: 3,
      maxPoints: 150,
      reorderMs: 20,
      startBitsPerSecond: 1e6,
      maxBitsPerSecond: 1e6,
      now: monotonicMs,
    },
    {
      send: (message) => sent.push(message),
      onFrame: () => undefined,
      onRobotsChanged: () => undefined,
      onSelected: () => undefined,
      onRobotFailed: () => failures.emit('failed'),
    },
  );
  onTestFinished(() => made.close());
  /** Waits until this many connections have failed. */
  const failed = async (count: number) => {
    while (made.failed < count) await once(failures, 'failed');
  };
  return { made, sent, failed };
}

function listed(id: number, sdpOffer: string): ReferenceRobot {
  return { id, name: 'robot', sdpOffer, sdpAnswer: null, robotCandidates: [], clientCandidates: [] };
}

it('answers an offer once, however often the service lists it', async () => {
  const { made, failed } = roster();
  // Registered twice on one socket, as the reference signaling lists it: 0 is a registration that has ended.
  const robots = [listed(0, 'v=0\r\nm=nonsense'), listed(1, 'v=0\r\nm=nonsense')];
  made.onSignaling({ type: 'robots', robots });
  await failed(2);
  made.onSignaling({ type: 'robots', robots });
  expect([made.size, made.failed]).toEqual([0, 2]);
  // The next offer is a different one.
  made.onSignaling({ type: 'robots', robots: [listed(0, 'v=0\r\nm=other'), robots[1] as ReferenceRobot] });
  expect(made.size).toBe(1);
  await failed(3);
});

it('asks for the list if a service does not say which robot left', () => {
  const { made, sent } = roster();
  made.onSignaling({ type: 'deregister' });
  expect(sent).toEqual([{ type: 'getRobots' }]);
});
