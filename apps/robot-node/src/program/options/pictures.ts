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
  picturesQuality: defineOption({
    schema: schema.integer({ min: 10, max: 95 }),
    default: 70,
    argument: 'N',
    file: 'quality',
    help: 'JPEG quality: 10 (small files) to 95 (fine pictures)',
  }),
  picturesShare: defineOption({
    schema: schema.number({ min: 0.01, max: 0.5 }),
    default: 0.15,
    argument: 'SHARE',
    file: 'share',
    help: 'maximum share of the link’s estimated rate for pictures; less below 4 Mbit/s, nothing below 0.5',
  }),
});
