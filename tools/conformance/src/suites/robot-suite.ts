import { LATENCY_TEST_COLOUR, zeroTwist } from '@farpoint/protocol';
import { checkOffer } from '../offer-rules.ts';
import { ReferenceOperator } from '../peers/reference-operator.ts';
import { RTP_HEADER_BYTES, RtpStreamRules } from '../rtp-rules.ts';
import { type ConformanceCase, must } from './suite.ts';

/** A robot that is registered, or will be. */
export interface RobotTarget {
  /** Clients' port of its signaling. */
  client: string;
  /** The name under which it registers. */
  name: string;
}

const FRAMES = 20;
/** After `stop`, packets in transit may still arrive; then there must be none for this long. */
const QUIET_MS = 400;
const STOP_WITHIN_MS = 3000;

function withOperator(
  run: (operator: ReferenceOperator) => Promise<void>,
): ConformanceCase<RobotTarget>['run'] {
  return async ({ client, name }) => {
    const operator = await ReferenceOperator.connect(client, name);
    try {
      await run(operator);
    } finally {
      await operator.leave();
    }
  };
}

export const robotSuite: readonly ConformanceCase<RobotTarget>[] = [
  {
    name: 'offers the reference profile and nothing else',
    run: withOperator(async ({ offer, robotChannels }) => {
      const findings = checkOffer(offer);
      must(findings.length === 0, findings.map(({ rule, detail }) => `${rule}: ${detail}`).join('; '));
      const [control, ...others] = robotChannels;
      must(
        control?.label === 'controltrack' && others.length === 0,
        `channels ${JSON.stringify(robotChannels)}`,
      );
      must(control.ordered && control.reliable, 'its control channel is not ordered and reliable');
    }),
  },
  {
    name: 'sends packets of the reference profile from "start" on',
    run: withOperator(async (operator) => {
      const rules = new RtpStreamRules();
      operator.onPacket = (packet) => rules.add(packet);
      operator.say('start');
      await operator.packets.next(() => rules.frames >= FRAMES, 15_000, `${FRAMES} frames`);
      must(rules.findings.length === 0, JSON.stringify(rules.findings.slice(0, 5)));
    }),
  },
  {
    name: 'sends nothing before "start", whatever the previous operator sent',
    defect: 'streams-unasked',
    run: withOperator(async (operator) => {
      const packet = await operator.packets.next(undefined, QUIET_MS).catch(() => null);
      must(packet === null, 'packets come unasked');
    }),
  },
  {
    name: 'pauses at "stop"',
    run: withOperator(async (operator) => {
      operator.say('start');
      await operator.packets.next(undefined, 10_000, 'a packet');
      operator.say('stop');
      const deadline = performance.now() + STOP_WITHIN_MS;
      for (;;) {
        const more = await operator.packets.next(undefined, QUIET_MS).catch(() => null);
        if (more === null) break;
        must(performance.now() < deadline, 'packets go on coming');
      }
      operator.say('start');
      await operator.packets.next(undefined, 10_000, 'a packet after the pause');
    }),
  },
  {
    name: 'makes a green frame where linear.z is not 0',
    run: withOperator(async (operator) => {
      operator.say('start');
      await operator.packets.next(undefined, 10_000, 'a packet');
      const twist = zeroTwist();
      twist.linear.z = 1;
      operator.command(twist);
      await operator.packets.next(isGreen, 10_000, 'a green packet');
    }),
  },
  {
    name: 'keeps streaming, whatever arrives on its channels',
    run: withOperator(async (operator) => {
      for (const bytes of [
        new Uint8Array([0]),
        new Uint8Array([0xff, 0xfe]),
        new TextEncoder().encode('{"linear":'),
      ]) {
        operator.sendControl(bytes);
        operator.sendBandwidth(bytes);
        operator.say(bytes);
      }
      operator.sendControl('null');
      operator.say('begin');
      operator.say('start');
      await operator.packets.next(undefined, 10_000, 'a packet');
    }),
  },
];

function isGreen(packet: Uint8Array): boolean {
  const from = RTP_HEADER_BYTES + 16 + 900;
  const view = new DataView(packet.buffer, packet.byteOffset + from, 300);
  for (let at = 0; at < 300; at += 2) if (view.getUint16(at, true) !== LATENCY_TEST_COLOUR) return false;
  return true;
}
