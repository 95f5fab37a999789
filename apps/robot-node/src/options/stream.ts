/** What operators are sent. */
import { POINTS_PER_PACKET } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import { PLAN_POLICIES } from '../encode/plan.ts';
import { STREAM_MODES } from '../encode/stream-mode.ts';

export const streamOptions = optionGroup('stream', {
  mode: defineOption({
    schema: schema.choice(STREAM_MODES),
    default: 'auto',
    argument: 'MODE',
    help: 'auto: the best format that the operator reads, the whole cloud where the rate allows; points64: the reference format, a sample of the cloud',
  }),
  bitrateMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 60,
    argument: 'MBPS',
    help: 'most the stream to an operator may take on the wire, 10^6 bit/s, headers counted',
  }),
  rateControl: defineOption({
    schema: schema.choice(['adaptive', 'fixed']),
    default: 'adaptive',
    argument: 'KIND',
    help: 'adaptive: what the link is found to carry; fixed: always the most, halved on sustained loss',
  }),
  startMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 3,
    argument: 'MBPS',
    help: 'rate of the first moments, before anything is known of the link, 10^6 bit/s',
  }),
  plan: defineOption({
    schema: schema.choice(PLAN_POLICIES),
    default: 'latency',
    argument: 'POLICY',
    help: 'latency: as many frames a second as the rate makes pictures of; paper: every frame, points by its equations 2 and 3',
  }),
  maxPoints: defineOption({
    schema: schema.integer({ min: POINTS_PER_PACKET, max: 4_194_304 }),
    default: 4_194_304,
    argument: 'N',
    help: 'most points of a points64 frame, whatever the rate allows',
  }),
  lambda: defineOption({
    schema: schema.number({ min: 0, max: 64 }),
    // As the reference system ships. With 3 and more, a budget below the points nearer than D leaves nothing beyond it.
    default: 1,
    argument: 'L',
    help: 'how fast a point’s weight falls with depth; 0 draws evenly',
  }),
  epsilon: defineOption({
    schema: schema.number({ min: 1e-12, max: 1 }),
    default: 1e-6,
    argument: 'E',
    help: 'keeps the weight of the nearest points finite',
  }),
  priorityDistance: defineOption({
    schema: schema.number({ min: 0, max: 1000 }),
    default: 3.85,
    argument: 'METRES',
    help: 'points nearer than this weigh as much as the nearest',
  }),
  floor: defineOption({
    schema: schema.number({ min: 0, max: 1 }),
    default: 0.1,
    argument: 'FRACTION',
    help: 'with --plan paper: fraction of the raw cloud that is sent each second whatever the rate',
  }),
});
