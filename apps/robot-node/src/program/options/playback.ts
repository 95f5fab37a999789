/** Clouds from files: which files, and how they are played. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const playbackOptions = optionGroup('source', {
  path: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'PATH',
    help: 'pcd: a .pcd file or a folder of them; rgbd: a folder in Open3D’s layout; recording: an MCAP file or a ROS 1 bag',
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
  playBeside: defineOption({
    schema: schema.choice(['all', 'videos', 'telemetry', 'none']),
    default: 'all',
    argument: 'WHAT',
    help: 'recording: what is played beside the clouds: its videos, as cameras of this robot; its telemetry (quantities, alarms and diagnostics, marked as recorded); all, or none',
  }),
  playEnd: defineOption({
    schema: schema.choice(['repeat', 'stop']),
    default: 'repeat',
    argument: 'WHAT',
    help: 'recording: at the end, repeat, or stop at the last cloud',
  }),
});
