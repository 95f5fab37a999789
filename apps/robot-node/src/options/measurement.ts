/** Files for measurements. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const measurementOptions = optionGroup('measurement', {
  packetLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: when each packet was sent, as CSV, written when the robot stops',
  }),
  frameLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: when each frame was captured and ready, as CSV, written when the robot stops',
  }),
  stats: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: what each stream does in each 100 ms, one JSON object a line',
  }),
});
