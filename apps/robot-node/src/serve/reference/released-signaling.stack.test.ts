/** The robot program at a stand-in for the reference system's released signaling, with its defects. */
import { ReferenceOperator } from '@farpoint/conformance';
import { ReleasedSignaling } from '@farpoint/conformance/testing';
import { LocalStack } from '@farpoint/local-stack';
import { expect, it } from 'vitest';

const ID = 'sim-2';
const NAME = 'Other';
const ARGS = ['--sim-size', '64', '--max-points', '650'];

it('is listed once even if signaling ignores the deregistration of robot 0, and takes no answer to a dead offer', {
  timeout: 60_000,
}, async () => {
  const released = await ReleasedSignaling.start();
  const args = [...ARGS, '--reference-signaling', released.robotUrl];
  const stack = await LocalStack.start({ robots: [{ id: ID, name: NAME, args }] });
  try {
    let lastId = -1;
    for (let i = 0; i < 3; i++) {
      const operator = await ReferenceOperator.connect(released.clientUrl, NAME);
      expect(operator.robotId).toBeGreaterThan(lastId);
      expect(released.listed).toEqual([operator.robotId]);
      lastId = operator.robotId;
      operator.say('start');
      await operator.packets.next();
      await operator.close();
    }
  } finally {
    await stack.stop();
    await released.stop();
  }
});
