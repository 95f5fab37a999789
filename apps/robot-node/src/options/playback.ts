/** Clouds from files: what is played, and how. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const playbackOptions = optionGroup('source', {
  path: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'PATH',
    help: 'pcd: a .pcd file or a folder of them; rgbd: a folder as Open3D lays it out; recording: an MCAP file or a ROS 1 bag',
  }),
  pcdFrame: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'FRAME',
    help: 'axes of PCD points: optical (z forward), body (x forward, z up), or auto: optical for grids, else body',
  }),
  topic: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'TOPIC',
    help: 'recording: which clouds; left out, the topic with most of them',
  }),
  playRate: defineOption({
    schema: schema.number({ min: 0.01, max: 100 }),
    default: 1,
    argument: 'FACTOR',
    help: 'recording: how much faster than it was recorded',
  }),
  playFromS: defineOption({
    schema: schema.number({ min: 0 }),
    default: 0,
    argument: 'SECONDS',
    help: 'recording: where to begin',
  }),
  playEnd: defineOption({
    schema: schema.choice(['repeat', 'stop']),
    default: 'repeat',
    argument: 'WHAT',
    help: 'recording: at its end repeat, or stop with the last cloud',
  }),
  playAxes: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'AXES',
    help: 'recording: axes of the clouds’ frame: optical (z forward), body (x forward, z up), or auto: optical where its name says so',
  }),
});
