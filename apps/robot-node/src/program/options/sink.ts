/** Where velocities go. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const SINK_KINDS = ['source', 'shm', 'ros1', 'ros2'] as const;

export const sinkOptions = optionGroup('sink', {
  sink: defineOption({
    schema: schema.choice(SINK_KINDS),
    default: 'source',
    argument: 'KIND',
    file: 'kind',
    help: 'where velocities go: source (the simulator’s wheels), shm (the reference system’s command block), ros1 or ros2 (the topic with as: velocity)',
  }),
  shmAccess: defineOption({
    schema: schema.choice(['owner', 'group']),
    default: 'owner',
    argument: 'WHO',
    help: 'who may read and write the files that --sink shm creates: owner (0600), or group (0660)',
  }),
  shmReader: defineOption({
    schema: schema.choice(['auto', 'required']),
    default: 'auto',
    argument: 'WHEN',
    help: 'when motion needs a program that reads the velocities and answers: auto (once it has answered), or required (always)',
  }),
});
