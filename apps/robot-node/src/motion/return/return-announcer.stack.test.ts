/** Whether the robot drives back by itself, as other nodes of a ROS 2 graph hear it. */
import { DdsGraph, isAvailable } from '@farpoint/dds';
import { testDomain } from '@farpoint/dds/testing';
import { expect, test } from 'vitest';
import { monotonicMs } from '../../ground/clock.ts';
import { boolMessage } from '../stops/bool-message.ts';
import { ReturnAnnouncer } from './return-announcer.ts';

test.skipIf(!isAvailable())(
  'says true while the robot drives back, and repeats it',
  { timeout: 20_000 },
  async () => {
    const domain = testDomain();
    const listener = new DdsGraph({ domain, localhostOnly: true, now: monotonicMs });
    const heard: boolean[] = [];
    const waiters = new Set<() => void>();
    const topic = '/returning';
    const subscription = listener.subscribe({ topic, type: 'std_msgs/msg/Bool', queue: 16 }, (bytes) => {
      heard.push(bytes[4] === boolMessage(2, true)[4]);
      for (const look of waiters) look();
    });
    const until = (is: () => boolean) =>
      new Promise<void>((resolve) => {
        const look = () => is() && waiters.delete(look) && resolve();
        waiters.add(look);
        look();
      });
    const faults: unknown[] = [];
    const graph = { kind: 'ros2', name: 'robot', graph: 'dds', domain, localhostOnly: true } as const;
    const announcer = new ReturnAnnouncer({ graph, topic }, { warn: (entry: unknown) => faults.push(entry) });
    try {
      await until(() => heard.at(-1) === false);
      announcer.say(true);
      await until(() => heard.slice(-3).every((said) => said));
      announcer.say(false);
      await until(() => heard.at(-1) === false);
      expect(faults).toEqual([]);
    } finally {
      await announcer.close();
      subscription.close();
      await listener.close();
    }
  },
);
