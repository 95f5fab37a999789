/** Camera pictures that operators see beside the cloud. */
import { MAX_PICTURE_SIDE } from '@farpoint/protocol';
import { defineOption, optionGroup, schema } from '@farpoint/service';

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
