/** The real robot program with a stand-in for an OpenTelemetry collector. */
import { LocalStack } from '@farpoint/local-stack';
import { eventually } from '@farpoint/service/testing/eventually';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { metricOf } from './testing/metric-of.ts';
import { attributesOf, OtlpCollector } from './testing/otlp-collector.ts';
import { SignaledOperator } from './testing/signaled-operator.ts';
import { driveUntil } from './testing/steady-hand.ts';

const [EXPORTING, SILENT] = ['exporting', 'silent'];
const ARGS = ['--rate-control', 'fixed', '--sim-size', '64', '--max-points', '600'];

let collector: OtlpCollector;
let stack: LocalStack;

beforeAll(async () => {
  collector = await OtlpCollector.listen();
  const robots = [
    { id: EXPORTING, name: 'Exporting robot', args: [...ARGS, '--otlp-endpoint', collector.url] },
    { id: SILENT, name: 'Silent robot', args: ARGS },
  ];
  stack = await LocalStack.start({ signalingArgs: [], robots });
}, 60_000);
afterAll(async () => {
  await stack.stop();
  await collector.close();
}, 30_000);

/** Drives until something is so, as an operator of its own. */
async function drive(robot: string, is: () => boolean | Promise<boolean>): Promise<void> {
  const operator = await SignaledOperator.connect(stack.signalingUrl, robot);
  const { client } = operator;
  const lease = await client.takeLease();
  let done = false;
  void eventually(is).then(() => {
    done = true;
  });
  await driveUntil(client, lease, 0, () => done && client.completeFrames.length > 10);
  await operator.close();
}

it('exports clouds and commands as spans that a strict collector takes', { timeout: 60_000 }, async () => {
  const named = (name: string) => collector.spans.filter((span) => span.name === name);
  await drive(EXPORTING, () => named('wheels').length > 3 && named('cloud').length > 3);
  expect(collector.faults).toEqual([]);
  const cloud = named('cloud').at(-1)!;
  expect(attributesOf(cloud)).toEqual({
    'farpoint.operator': 1,
    'farpoint.sensor': 0,
    'farpoint.frame': expect.any(Number),
    'farpoint.points': 600,
  });
  const children = collector.spans.filter(({ parentSpanId }) => parentSpanId === cloud.spanId);
  expect(children.map(({ name }) => name)).toEqual(['capture', 'guard-and-encode', 'queue']);
  const ageMs = Date.now() - Number(BigInt(cloud.startTimeUnixNano) / 1_000_000n);
  // Real time: within this test.
  expect(ageMs).toBeGreaterThan(0);
  expect(ageMs).toBeLessThan(60_000);
  expect(
    await metricOf(stack.robotAdminUrl(EXPORTING), 'farpoint_robot_spans_total{outcome="sent"}'),
  ).toBeGreaterThan(0);
});

it('exports nothing unless an endpoint is named', { timeout: 60_000 }, async () => {
  await drive(SILENT, () => true);
  const { requests } = collector;
  await drive(EXPORTING, () => collector.requests > requests + 1);
  expect(collector.senders).toEqual(new Set([EXPORTING]));
  await expect(metricOf(stack.robotAdminUrl(SILENT), 'farpoint_robot_spans_total')).rejects.toThrow(
    'no metric',
  );
});

it('drives on while the collector hangs', { timeout: 60_000 }, async () => {
  collector.answer = 'nothing';
  const before = collector.requests;
  await drive(EXPORTING, () => collector.requests > before);
  const accepted = () => metricOf(stack.robotAdminUrl(EXPORTING), 'farpoint_robot_commands_accepted_total');
  const sofar = await accepted();
  await drive(EXPORTING, async () => (await accepted()) > sofar + 20);
});
