/** Clouds from a producer in shared memory. */
import { defineOption, optionGroup, schema } from '@farpoint/service';
import { DEFAULT_FOLDER } from '@farpoint/shared-memory';

export const shmOptions = optionGroup('source', {
  shmLayout: defineOption({
    schema: schema.choice(['farpoint', 'reference']),
    default: 'farpoint',
    argument: 'LAYOUT',
    help: 'shm: layout: farpoint (frames as the camera gives them), or reference (the reference system’s packed points)',
  }),
  shmFolder: defineOption({
    schema: schema.text(),
    default: DEFAULT_FOLDER,
    argument: 'FOLDER',
    help: 'folder of the shared-memory files, for both source and sink',
  }),
  shmWaitS: defineOption({
    schema: schema.number({ min: 0, max: 3600 }),
    default: 10,
    argument: 'SECONDS',
    help: 'shm: how long to wait for the producer at startup',
  }),
});
