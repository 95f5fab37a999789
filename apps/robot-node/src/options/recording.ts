/** What is recorded. */
import { defineOption, optionGroup, schema } from '@farpoint/service';

export const recordingOptions = optionGroup('recording', {
  record: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    file: 'file',
    help: 'record clouds, pictures, commands, telemetry, rate estimates and latencies to this MCAP file; there must be none yet',
  }),
  recordCapturedFps: defineOption({
    schema: schema.number({ min: 0.1, max: 120 }),
    default: 5,
    argument: 'RATE',
    file: 'capturedFps',
    help: 'record: most clouds a second as captured, 16 bytes a point; those sent are all recorded as sent, too',
  }),
  recordCompression: defineOption({
    schema: schema.choice(['none', 'zstd']),
    default: 'none',
    argument: 'KIND',
    file: 'compression',
    help: 'record: none, or zstd (smaller, and more work for the processor)',
  }),
});
