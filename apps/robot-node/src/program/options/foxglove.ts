/** The live server for Foxglove and Lichtblick. */
import { defineOption, optionGroup, schema } from '@farpoint/service';
import { FOXGLOVE_REACHES } from '../../tell/recording-options.ts';

export const foxgloveOptions = optionGroup('foxglove', {
  foxglovePort: defineOption({
    schema: schema.optional(schema.port()),
    default: null,
    argument: 'PORT',
    file: 'port',
    help: 'serve what a recording contains live to Foxglove and Lichtblick on this port, usually 8765; default: no server',
  }),
  foxgloveReach: defineOption({
    schema: schema.choice(FOXGLOVE_REACHES),
    default: 'localhost',
    argument: 'REACH',
    file: 'reach',
    help: 'foxglove: localhost, or network: everybody in this machine’s networks can watch, without a password',
  }),
  foxgloveOrigins: defineOption({
    schema: schema.list(schema.text()),
    default: [],
    argument: 'ORIGIN,…',
    file: 'origins',
    help: 'foxglove: origins of web pages that may connect, in addition to app.foxglove.dev and pages of this machine; * for all',
  }),
  foxgloveFps: defineOption({
    schema: schema.number({ min: 0.1, max: 120 }),
    default: 5,
    argument: 'RATE',
    file: 'fps',
    help: 'foxglove: maximum clouds a second, of each kind; a cloud takes 16 bytes a point',
  }),
});
