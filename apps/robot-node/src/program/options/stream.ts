/** What operators receive. */
import { MAX_PICTURE_SIDE, MAX_POINTS_PER_FRAME, POINTS_PER_PACKET } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';
import { PLAN_POLICIES, STREAM_MODES } from '../../sense/encode/plan.ts';

/** Camera pictures that operators see beside the cloud. */
export const picturesOptions = optionGroup('pictures', {
  picturesOfCloud: defineOption({
    schema: schema.boolean(),
    default: false,
    file: 'ofCloud',
    help: 'also show the colour picture of the depth camera that the cloud comes from, including the simulated one; topics of pictures are listed in topics, with as: picture',
  }),
  picturesPerSecond: defineOption({
    schema: schema.number({ min: 0.1, max: 30 }),
    default: 10,
    argument: 'RATE',
    file: 'perSecond',
    help: 'maximum pictures a second of each camera',
  }),
  picturesLongestSide: defineOption({
    schema: schema.integer({ min: 16, max: MAX_PICTURE_SIDE }),
    default: 640,
    argument: 'PIXELS',
    file: 'longestSide',
    help: 'longest side of a picture; larger ones are shrunk by a whole factor, and further on a slow link',
  }),
});

export const streamOptions = optionGroup('stream', {
  mode: defineOption({
    schema: schema.choice(STREAM_MODES),
    default: 'auto',
    argument: 'MODE',
    help: 'auto: the best format that the operator supports, with the whole cloud if the rate allows; points64: the reference format, a sample of the cloud',
  }),
  bitrateMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 60,
    argument: 'MBPS',
    help: 'maximum rate of the stream to an operator on the wire, including headers, 10^6 bit/s',
  }),
  rateControl: defineOption({
    schema: schema.choice(['adaptive', 'fixed']),
    default: 'adaptive',
    argument: 'KIND',
    help: 'adaptive: the estimated rate of the link; fixed: always the maximum, halved on sustained loss',
  }),
  startMbps: defineOption({
    schema: schema.number({ min: 0.1, max: 1000 }),
    default: 3,
    argument: 'MBPS',
    help: 'initial rate, before anything is known about the link, 10^6 bit/s',
  }),
  plan: defineOption({
    schema: schema.choice(PLAN_POLICIES),
    default: 'latency',
    argument: 'POLICY',
    help: 'latency: as many frames a second as the rate can fill with useful pictures; paper: every frame, with points by the paper’s equations 2 and 3',
  }),
  maxPoints: defineOption({
    schema: schema.integer({ min: POINTS_PER_PACKET, max: MAX_POINTS_PER_FRAME }),
    default: 4_194_304,
    argument: 'N',
    help: 'maximum points in a points64 frame, even if the rate allows more',
  }),
  lambda: defineOption({
    schema: schema.number({ min: 0, max: 64 }),
    // As in the reference system's release. From 3 on, a budget below the number of points nearer than D leaves
    // nothing beyond D.
    default: 1,
    argument: 'L',
    help: 'how fast a point’s weight falls with depth; 0 samples evenly',
  }),
  priorityDistance: defineOption({
    schema: schema.number({ min: 0, max: 1000 }),
    default: 3.85,
    argument: 'METRES',
    help: 'points nearer than this have the same weight as the nearest',
  }),
});
