/**
 * An operator whose WebRTC stack gives no transport-wide feedback still gets a full stream: RTCP receiver reports are
 * used instead.
 */
import { LocalStack } from '@farpoint/local-stack';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { SignaledOperator } from './testing/signaled-operator.ts';

const ROBOT = 'sim-1';
let stack: LocalStack;

beforeAll(async () => {
  const args = ['--start-mbps', '1', '--bitrate-mbps', '4'];
  stack = await LocalStack.start({ robots: [{ id: ROBOT, name: 'Simulated robot', args }] });
}, 60_000);
afterAll(async () => {
  await stack.stop();
}, 30_000);

describe('without transport-wide feedback', { timeout: 60_000 }, () => {
  it('the rate grows from receiver reports, and the robot says so', async () => {
    const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT, { transportFeedback: false });
    const { client } = operator;
    await client.until(() => client.telemetry?.stream.feedback === 'reports');
    await client.until(() => (client.telemetry?.stream.targetBitsPerSecond ?? 0) > 2e6);
    expect(client.malformedPackets).toBe(0);
    const metrics = await (await fetch(`${stack.robotAdminUrl(ROBOT)}/metrics`)).text();
    expect(metrics).toContain('farpoint_robot_rate_state{state="reports"} 1');
    await operator.close();
  });

  it('with it, the robot says nothing', async () => {
    const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    const { client } = operator;
    await client.until(() => (client.telemetry?.stream.targetBitsPerSecond ?? 0) > 0);
    expect(client.telemetry?.stream.feedback).toBeUndefined();
    await operator.close();
  });
});
