/** Files for measurements. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const measurementOptions = optionGroup('measurement', {
  packetLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: write the time at which each packet was sent, as CSV, when the robot stops',
  }),
  frameLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: write the times at which each frame was captured and ready, as CSV, when the robot stops',
  }),
  commandLog: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: write the times at which each command was sent and received, as CSV, when the robot stops',
  }),
  stats: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    help: 'for measurements: write the statistics of each stream every 100 ms, one JSON object a line',
  }),
});
