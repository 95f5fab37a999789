/** What is recorded. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const RECORDED_CLOUDS = ['sent', 'captured', 'both', 'none'] as const;
/** A file with nothing but its topics has some 20 kB. */
const LEAST_BYTES = 1_000_000;

export const recordingOptions = optionGroup('recording', {
  record: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    file: 'file',
    help: 'record clouds, pictures, commands, telemetry, rate estimates and latencies to this MCAP file; there must be none yet',
  }),
  recordClouds: defineOption({
    schema: schema.choice(RECORDED_CLOUDS),
    default: 'sent',
    argument: 'KIND',
    file: 'clouds',
    help: 'record: which clouds: sent (as operators got them), captured (as the source gave them), both, none; each takes 16 bytes a point',
  }),
  recordSentFps: defineOption({
    schema: schema.number({ min: 0.1, max: 120 }),
    default: 10,
    argument: 'RATE',
    file: 'sentFps',
    help: 'record: most clouds a second as sent',
  }),
  recordCapturedFps: defineOption({
    schema: schema.number({ min: 0.1, max: 120 }),
    default: 5,
    argument: 'RATE',
    file: 'capturedFps',
    help: 'record: most clouds a second as captured, with --record-clouds captured or both',
  }),
  recordMax: defineOption({
    schema: schema.size({ min: LEAST_BYTES, none: true }),
    default: 4e9,
    argument: 'SIZE',
    file: 'max',
    help: 'record: the file ends, whole, before it is larger, and the robot goes on; e.g. 500MB, 4GB, none',
  }),
  recordCompression: defineOption({
    schema: schema.choice(['none', 'zstd']),
    default: 'none',
    argument: 'KIND',
    file: 'compression',
    help: 'record: none, or zstd (smaller, and more work for the processor)',
  }),
});
