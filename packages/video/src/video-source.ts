/** Where the pictures come from: configuration in, the text of a GStreamer pipeline out. */
import { gstPipelineSchema } from '@farpoint/media-process';
import * as z from 'zod';
import { sideSchema } from './video-settings.ts';

/** The name of the element that takes raw pictures; `native/pipeline.c` looks for it. */
const FRAMES_ELEMENT = 'farpoint-frames';

const rate = z.number('must be a number').min(1, 'must be at least 1').max(240, 'must be at most 240');

export const TEST_PATTERNS = ['smpte', 'ball', 'snow', 'pinwheel', 'black', 'white', 'checkers-8'] as const;

const test = z.strictObject({
  kind: z.literal('test'),
  pattern: z.enum(TEST_PATTERNS, `must be one of ${TEST_PATTERNS.join(', ')}`).default('pinwheel'),
  width: sideSchema.default(1024),
  height: sideSchema.default(768),
  framesPerS: rate.default(30),
});

const v4l2 = z.strictObject({
  kind: z.literal('v4l2'),
  device: z
    .string('must be text')
    .regex(/^\/dev\/[A-Za-z0-9_./:+-]{1,200}$/, 'must be a device such as /dev/video0')
    .refine((device) => !device.includes('..'), 'must be a device such as /dev/video0'),
  /** What the camera sends: raw pictures, or JPEG, without which USB 2 carries few large pictures. */
  format: z.enum(['raw', 'jpeg'], 'must be raw or jpeg').default('raw'),
  width: sideSchema.optional(),
  height: sideSchema.optional(),
  framesPerS: rate.optional(),
});

const rtsp = z.strictObject({
  kind: z.literal('rtsp'),
  url: z
    .string('must be text')
    .max(2000, 'must have at most 2000 characters')
    .refine(isRtspUrl, 'must be an address such as rtsp://camera/stream'),
  /** How long packets wait for those that are late. */
  latencyMs: z.int().min(0, 'must be at least 0').max(5000, 'must be at most 5000').default(50),
  transport: z.enum(['tcp', 'udp'], 'must be tcp or udp').default('tcp'),
});

const frames = z.strictObject({ kind: z.literal('frames') });

export const videoSourceSchema = z.discriminatedUnion('kind', [test, v4l2, rtsp, gstPipelineSchema, frames]);
export type VideoSourceOptions = z.input<typeof videoSourceSchema>;
export type VideoSource = z.output<typeof videoSourceSchema>;

/** The source's part of the pipeline. */
export function sourceText(source: VideoSource): string {
  switch (source.kind) {
    case 'test':
      // Not live: such a source would begin whenever it is ready. The pipeline paces it, from the instant that it chose.
      return `videotestsrc pattern=${source.pattern} ! ${caps('video/x-raw', source)}`;
    case 'v4l2': {
      const from = `v4l2src device=${quoted(source.device)}`;
      if (source.format === 'jpeg') return `${from} ! ${caps('image/jpeg', source)} ! jpegdec`;
      return `${from} ! ${caps('video/x-raw', source)}`;
    }
    case 'rtsp':
      return [
        `rtspsrc location=${quoted(source.url)} latency=${source.latencyMs} drop-on-latency=true protocols=${source.transport}`,
        'application/x-rtp,media=video',
        'decodebin',
      ].join(' ! ');
    case 'gst':
      return source.pipeline;
    case 'frames':
      return `appsrc name=${FRAMES_ELEMENT} is-live=true format=time max-buffers=1 leaky-type=downstream`;
  }
}

/** How long such a source may be silent before it counts as lost, ms; 0: for ever. */
export function silenceMs(source: VideoSource): number {
  if (source.kind === 'frames') return 0;
  // A camera in a network is found first, and sends its first key frame when it likes.
  return source.kind === 'rtsp' || source.kind === 'gst' ? 15_000 : 5000;
}

interface Shape {
  width?: number | undefined;
  height?: number | undefined;
  framesPerS?: number | undefined;
}

function caps(type: string, { width, height, framesPerS }: Shape): string {
  const fields = [type];
  if (width !== undefined) fields.push(`width=${width}`);
  if (height !== undefined) fields.push(`height=${height}`);
  if (framesPerS !== undefined)
    fields.push(
      Number.isInteger(framesPerS)
        ? `framerate=${framesPerS}/1`
        : `framerate=${Math.round(framesPerS * 1000)}/1000`,
    );
  return fields.join(',');
}

/** A text value in a pipeline. */
export function quoted(text: string): string {
  return `"${text.replaceAll(/[\\"]/g, '\\$&')}"`;
}

/** Visible ASCII only; anything else is percent-encoded in an address. */
function isRtspUrl(text: string): boolean {
  if (!/^rtsps?:\/\/[!-~]+$/.test(text) || text.includes('"') || text.includes('\\')) return false;
  return URL.canParse(text) && new URL(text).hostname !== '';
}
