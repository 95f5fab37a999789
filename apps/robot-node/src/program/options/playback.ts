/** Clouds from files: which files, and how they are played. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const playbackOptions = optionGroup('source', {
  path: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'PATH',
    help: 'pcd: a .pcd file or a folder of them; rgbd: a folder in Open3D’s layout; recording: an MCAP file or a ROS 1 bag',
  }),
  pcdFrame: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'FRAME',
    help: 'pcd: axes of the points: optical (z forward), body (x forward, z up), or auto: optical for clouds on a grid, else body',
  }),
  topic: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'TOPIC',
    help: 'recording: topic of the clouds; default: the topic with the most clouds',
  }),
  playRate: defineOption({
    schema: schema.number({ min: 0.01, max: 100 }),
    default: 1,
    argument: 'FACTOR',
    help: 'recording: playing speed; 2 plays twice as fast as recorded',
  }),
  playFromS: defineOption({
    schema: schema.number({ min: 0 }),
    default: 0,
    argument: 'SECONDS',
    help: 'recording: where to start',
  }),
  playEnd: defineOption({
    schema: schema.choice(['repeat', 'stop']),
    default: 'repeat',
    argument: 'WHAT',
    help: 'recording: at the end, repeat, or stop at the last cloud',
  }),
  playVideos: defineOption({
    schema: schema.choice(['all', 'none']),
    default: 'all',
    argument: 'WHICH',
    help: 'recording: its videos become cameras of this robot, or none of them does',
  }),
  playVideosKbitPerS: defineOption({
    schema: schema.number({ min: 64, max: 50_000 }),
    default: 1500,
    argument: 'RATE',
    help: 'recording: maximum rate of each of these videos; a slow link gets less',
  }),
  playTelemetry: defineOption({
    schema: schema.choice(['all', 'none']),
    default: 'all',
    argument: 'WHICH',
    help: 'recording: its quantities, alarms and diagnostics appear on the dashboard, marked as recorded, or none of them does',
  }),
  playAxes: defineOption({
    schema: schema.choice(['auto', 'optical', 'body']),
    default: 'auto',
    argument: 'AXES',
    help: 'recording: axes of the clouds’ frame: optical (z forward), body (x forward, z up), or auto: optical if the frame’s name says so',
  }),
});
