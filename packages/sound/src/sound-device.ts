/** Where sound comes from and goes to: configuration in, the text of a GStreamer pipeline out. */
import { gstPipelineSchema } from '@farpoint/media-process';
import * as z from 'zod';

/** A device's name in ALSA or PulseAudio. */
const device = z
  .string('must be text')
  .regex(/^[A-Za-z0-9_.:,=@+/-]{1,200}$/, 'must be the name of a device, such as hw:1 or default');

const alsa = z.strictObject({ kind: z.literal('alsa'), device: device.default('default') });
const pulse = z.strictObject({ kind: z.literal('pulse'), device: device.optional() });
const pipewire = z.strictObject({ kind: z.literal('pipewire'), target: device.optional() });
const test = z.strictObject({
  kind: z.literal('test'),
  /** Of the tone, Hz. */
  frequency: z
    .number('must be a number')
    .min(50, 'must be at least 50')
    .max(8000, 'must be at most 8000')
    .default(440),
});
const auto = z.strictObject({ kind: z.literal('auto') });

export const soundSourceSchema = z.discriminatedUnion('kind', [
  test,
  alsa,
  pulse,
  pipewire,
  gstPipelineSchema,
]);
export type SoundSourceOptions = z.input<typeof soundSourceSchema>;
export type SoundSource = z.output<typeof soundSourceSchema>;

export const soundSinkSchema = z.discriminatedUnion('kind', [auto, alsa, pulse, pipewire, gstPipelineSchema]);
export type SoundSinkOptions = z.input<typeof soundSinkSchema>;
export type SoundSink = z.output<typeof soundSinkSchema>;

/** A device hands sound over in pieces of 10 ms, and holds at most 40 ms. */
const DEVICE_BUFFER = 'latency-time=10000 buffer-time=40000';

/** The source's part of a pipeline. */
export function sourceText(source: SoundSource): string {
  switch (source.kind) {
    case 'test':
      return `audiotestsrc wave=sine volume=0.25 freq=${source.frequency} samplesperbuffer=480`;
    case 'alsa':
      return `alsasrc device="${source.device}" ${DEVICE_BUFFER}`;
    case 'pulse':
      return `pulsesrc ${source.device === undefined ? '' : `device="${source.device}" `}${DEVICE_BUFFER}`;
    case 'pipewire':
      return `pipewiresrc${source.target === undefined ? '' : ` target-object="${source.target}"`}`;
    case 'gst':
      return source.pipeline;
  }
}

/** The sink's part of a pipeline. */
export function sinkText(sink: SoundSink): string {
  switch (sink.kind) {
    case 'auto':
      return 'autoaudiosink';
    case 'alsa':
      return `alsasink device="${sink.device}" ${DEVICE_BUFFER}`;
    case 'pulse':
      return `pulsesink ${sink.device === undefined ? '' : `device="${sink.device}" `}${DEVICE_BUFFER}`;
    case 'pipewire':
      return `pipewiresink${sink.target === undefined ? '' : ` target-object="${sink.target}"`}`;
    case 'gst':
      return sink.pipeline;
  }
}

/** How a microphone is encoded. */
export interface Encoding {
  /** Length of a packet. */
  readonly packetMs: 10 | 20;
  /** Sends less while it is quiet. Receivers then hear no background, so that a lost link and silence are alike. */
  readonly dtx: boolean;
}

/**
 * The older of what waits for the encoder is dropped after so long, ns. Chosen: five packets; later sound is
 * not sent either (sound-frame.ts of the robot).
 */
const QUEUE_NS = 100_000_000;

/** A whole pipeline: a microphone's. */
export function captureText(source: SoundSource, { packetMs, dtx }: Encoding): string {
  return [
    sourceText(source),
    'clocksync name=farpoint-pace sync=true',
    `queue leaky=downstream max-size-buffers=0 max-size-bytes=0 max-size-time=${QUEUE_NS}`,
    'audioconvert',
    'audioresample',
    'audio/x-raw,format=S16LE,rate=48000,channels=1,layout=interleaved',
    `opusenc name=farpoint-encoder frame-size=${packetMs} bitrate-type=constrained-vbr audio-type=voice inband-fec=true packet-loss-percentage=10 dtx=${dtx}`,
    'appsink name=farpoint-out sync=false async=false max-buffers=5 enable-last-sample=false',
  ].join(' ! ');
}

/** A whole pipeline: a loudspeaker's. */
export function playText(sink: SoundSink): string {
  return [
    'appsrc name=farpoint-packets is-live=true format=time max-buffers=16 leaky-type=downstream caps="audio/x-opus,channel-mapping-family=(int)0,rate=(int)48000,channels=(int)1"',
    'opusdec plc=true',
    'audioconvert',
    'audioresample',
    sinkText(sink),
  ].join(' ! ');
}
