/** The simulated robot. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const simOptions = optionGroup('source', {
  simSeed: defineOption({
    schema: schema.integer({ min: 0, max: 0xffffffff }),
    default: 1,
    argument: 'SEED',
    help: 'seed of the simulated robot’s sensor noise',
  }),
  simLidar: defineOption({
    schema: schema.boolean(),
    default: false,
    help: 'give the simulated robot a LiDAR in addition to its camera: 16 beams, 10 revolutions a second',
  }),
  simSize: defineOption({
    schema: schema.integer({ min: 16, max: 1024 }),
    default: 480,
    argument: 'PIXELS',
    help: 'width and height of the simulated camera, a multiple of 4',
  }),
});
