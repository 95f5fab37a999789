/** Where the clouds come from. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const SOURCE_KINDS = ['sim', 'pcd', 'rgbd', 'shm', 'recording', 'ros1', 'ros2'] as const;

export const sourceOptions = optionGroup('source', {
  source: defineOption({
    schema: schema.choice(SOURCE_KINDS),
    default: 'sim',
    argument: 'KIND',
    file: 'kind',
    help: 'where the points come from: sim (a simulated robot), pcd (recorded clouds), rgbd (recorded colour and depth images), shm (a camera’s program, through shared memory), recording (an MCAP file or a ROS 1 bag), ros1 or ros2 (topics of a ROS graph)',
  }),
  fps: defineOption({
    schema: schema.optional(schema.number({ min: 0.1, max: 120 })),
    default: null,
    argument: 'RATE',
    help: 'maximum frames a second to request from the source; default: 60 for the simulated camera, a recording’s own rate, 30 for others',
  }),
});
