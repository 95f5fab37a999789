/** The simulated robot. */
import { MAX_SENSORS } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const simOptions = optionGroup('source', {
  simSeed: defineOption({
    schema: schema.integer({ min: 0, max: 0xffffffff }),
    default: 1,
    argument: 'SEED',
    help: 'seed of the simulated robot’s sensor noise',
  }),
  simCharge: defineOption({
    schema: schema.number({ min: 0, max: 100 }),
    default: 95,
    argument: 'PERCENT',
    help: 'charge of the simulated robot’s battery at the start',
  }),
  simLidars: defineOption({
    schema: schema.integer({ min: 0, max: MAX_SENSORS - 1 }),
    default: 0,
    argument: 'N',
    help: 'number of LiDARs of the simulated robot, in addition to its camera: 16 beams, 10 revolutions a second each',
  }),
  simSize: defineOption({
    schema: schema.integer({ min: 16, max: 1024 }),
    default: 480,
    argument: 'PIXELS',
    help: 'width and height of the simulated camera, a multiple of 4',
  }),
});
