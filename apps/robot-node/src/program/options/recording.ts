/** What is recorded. */
import { defineOption, optionGroup, schema } from '@farpoint/service';
import { FOXGLOVE_REACHES, RECORDED_VIDEOS } from '../../tell/recording-options.ts';

/** The live server for Foxglove and Lichtblick. */
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

const RECORDED_CLOUDS = ['sent', 'captured', 'both', 'none'] as const;

/**
 * A file that contains only its topics takes some 20 kB; a smaller limit than 50 of these would begin files
 * all the time, bytes.
 */
const LEAST_BYTES = 1_000_000;

export const recordingOptions = optionGroup('recording', {
  record: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FILE',
    file: 'file',
    help: 'record clouds, pictures, commands, telemetry, rate estimates and latencies to this MCAP file, which must not exist yet',
  }),
  recordFolder: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FOLDER',
    file: 'folder',
    help: 'operators may begin and end recordings, each an MCAP file in this folder, which must exist; and mark instants in them (docs/commands.md)',
  }),
  recordFolderMax: defineOption({
    schema: schema.size({ min: LEAST_BYTES, none: true }),
    default: 20e9,
    argument: 'SIZE',
    file: 'folderMax',
    help: 'record: no further recording begins once the recordings in the folder have this size; none: no limit',
  }),
  recordBy: defineOption({
    schema: schema.choice(['auto', 'drive', 'supervise']),
    default: 'auto',
    argument: 'WHO',
    file: 'by',
    help: 'who may begin and end recordings in the folder: drive (every operator who may drive), supervise (supervisors), or auto: supervise where the robot asks for grants, else drive',
  }),
  recordClouds: defineOption({
    schema: schema.choice(RECORDED_CLOUDS),
    default: 'sent',
    argument: 'KIND',
    file: 'clouds',
    help: 'record: which clouds: sent (as operators got them), captured (as the source gave them), both, none; a cloud takes 16 bytes a point',
  }),
  recordFps: defineOption({
    schema: schema.number({ min: 0.1, max: 120 }),
    default: 10,
    argument: 'RATE',
    file: 'fps',
    help: 'record: maximum clouds a second, of each kind',
  }),
  recordVideos: defineOption({
    schema: schema.choice(RECORDED_VIDEOS),
    default: 'always',
    argument: 'WHEN',
    file: 'videos',
    help: 'record: the cameras that are streamed as video: always (also while nobody watches, which costs what encoding costs), watched (only while an operator watches them), none',
  }),
  recordMax: defineOption({
    schema: schema.size({ min: LEAST_BYTES, none: true }),
    default: 4e9,
    argument: 'SIZE',
    file: 'max',
    help: 'record: maximum size of a file, e.g. 500MB, 4GB, none; recording ends before the file exceeds it, and the robot goes on',
  }),
  recordCompression: defineOption({
    schema: schema.choice(['none', 'zstd']),
    default: 'none',
    argument: 'KIND',
    file: 'compression',
    help: 'record: none, or zstd (smaller files, more processor time)',
  }),
});

/** Where measurements are written. */
export const measurementOptions = optionGroup('measurement', {
  measure: defineOption({
    schema: schema.optional(schema.text()),
    default: null,
    argument: 'FOLDER',
    file: 'folder',
    help: 'for measurements: write to this folder when each packet was sent (packets.csv), each frame captured and ready (frames.csv), each command sent and received (commands.csv), all when the robot stops, and the statistics of each stream every 100 ms (streams.jsonl)',
  }),
});
