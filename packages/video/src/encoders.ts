/** The encoders that can be used: what each runs on, and its properties for low delay. */
import { type VideoFailure, videoFailure } from './video-failure.ts';

const VIDEO_CODECS = ['h264', 'vp8'] as const;
export type VideoCodec = (typeof VIDEO_CODECS)[number];

/** A property of an encoder that follows bit rate and frame rate: the sum of three products. */
export interface FollowingProperty {
  readonly name: string;
  /** Times the bit rate in bit/s. */
  readonly perBitPerS?: number;
  /** Times the time between two pictures in s. */
  readonly perInterval?: number;
  /** Times the bits that a picture has on average. */
  readonly perFrameBit?: number;
}

export interface VideoEncoder {
  /** The element's name. */
  readonly name: string;
  readonly codec: VideoCodec;
  readonly runsOn: 'CPU' | 'VA-API' | 'NVENC' | 'Jetson';
  /** Caps fields of the pictures it takes. */
  readonly raw: string;
  /** Elements in front of it. */
  readonly before?: string;
  readonly properties: string;
  readonly following: readonly FollowingProperty[];
  /** H.264 profile, if the element takes it from the caps behind it. */
  readonly profile?: string;
}

/** Too many frames for any session: a key frame comes on request, or after 10 s, which the process counts. */
const NEVER = 1_000_000_000;
/** What every browser must decode (RFC 7742). */
const BASELINE = 'constrained-baseline';
/**
 * The rate control's buffer, in intervals between pictures. A picture that needs more than its share of the link delays
 * all that follow. With two, none takes longer to send than two intervals, a key frame included: that is coarse at
 * first, and sharp again after a few pictures.
 */
const BUFFER_INTERVALS = 2;
const MS = 1000;
const KILO = 0.001;
/** The properties of hardware encoders are from their documentation; only the software encoders are tried in tests. */
export const VIDEO_ENCODERS: readonly VideoEncoder[] = [
  {
    name: 'nvh264enc',
    codec: 'h264',
    runsOn: 'NVENC',
    raw: 'format=NV12',
    properties: 'preset=low-latency-hp zerolatency=true rc-mode=cbr gop-size=-1 bframes=0 rc-lookahead=0',
    following: [
      { name: 'bitrate', perBitPerS: KILO },
      { name: 'vbv-buffer-size', perFrameBit: KILO * BUFFER_INTERVALS },
    ],
    profile: BASELINE,
  },
  {
    name: 'nvv4l2h264enc',
    codec: 'h264',
    runsOn: 'Jetson',
    raw: 'format=NV12',
    before: 'nvvidconv ! video/x-raw(memory:NVMM),format=NV12',
    properties:
      'control-rate=1 preset-level=1 maxperf-enable=true profile=0 poc-type=2 insert-sps-pps=true iframeinterval=100000 idrinterval=100000',
    following: [{ name: 'bitrate', perBitPerS: 1 }],
  },
  {
    name: 'omxh264enc',
    codec: 'h264',
    runsOn: 'Jetson',
    raw: 'format=NV12',
    properties: 'control-rate=2 preset-level=0 profile=1 insert-sps-pps=true iframeinterval=100000',
    following: [{ name: 'bitrate', perBitPerS: 1 }],
  },
  {
    name: 'vah264enc',
    codec: 'h264',
    runsOn: 'VA-API',
    raw: 'format=NV12',
    properties: 'rate-control=cbr target-usage=6 b-frames=0 ref-frames=1 key-int-max=1024',
    following: [
      { name: 'bitrate', perBitPerS: KILO },
      { name: 'cpb-size', perFrameBit: KILO * BUFFER_INTERVALS },
    ],
    profile: BASELINE,
  },
  {
    name: 'vaapih264enc',
    codec: 'h264',
    runsOn: 'VA-API',
    raw: 'format=NV12',
    properties: 'rate-control=cbr quality-level=6 max-bframes=0 refs=1 keyframe-period=100000 cpb-length=67',
    following: [{ name: 'bitrate', perBitPerS: KILO }],
    profile: BASELINE,
  },
  {
    name: 'x264enc',
    codec: 'h264',
    runsOn: 'CPU',
    raw: 'format=I420',
    properties: `tune=zerolatency speed-preset=superfast pass=cbr bframes=0 ref=1 aud=false key-int-max=${NEVER} option-string="scenecut=0" threads=THREADS`,
    following: [
      { name: 'bitrate', perBitPerS: KILO },
      { name: 'vbv-buf-capacity', perInterval: MS * BUFFER_INTERVALS },
    ],
    profile: BASELINE,
  },
  {
    name: 'openh264enc',
    codec: 'h264',
    runsOn: 'CPU',
    raw: 'format=I420',
    properties: `usage-type=camera complexity=low rate-control=bitrate scene-change-detection=false gop-size=${NEVER} slice-mode=n-slices num-slices=THREADS multi-thread=THREADS`,
    following: [
      { name: 'bitrate', perBitPerS: 1 },
      { name: 'max-bitrate', perBitPerS: 1 },
    ],
    profile: BASELINE,
  },
  {
    name: 'vp8enc',
    codec: 'vp8',
    runsOn: 'CPU',
    raw: 'format=I420',
    properties:
      'deadline=1 cpu-used=8 end-usage=cbr lag-in-frames=0 keyframe-mode=disabled max-intra-bitrate=300 undershoot=95 max-quantizer=56 static-threshold=1 threads=THREADS token-partitions=2',
    following: [
      { name: 'target-bitrate', perBitPerS: 1 },
      // Its rate control is not exact to a picture, and blurs everything if it has no more than its share.
      { name: 'buffer-size', perInterval: MS * 3 * BUFFER_INTERVALS },
      { name: 'buffer-optimal-size', perInterval: MS * 2 * BUFFER_INTERVALS },
      { name: 'buffer-initial-size', perInterval: MS * BUFFER_INTERVALS },
    ],
  },
];

/** What GStreamer has on this machine. */
export interface AvailableEncoder {
  readonly name: string;
  readonly codec: VideoCodec;
}

export type ChosenEncoder =
  | { readonly ok: true; readonly encoder: VideoEncoder }
  | { readonly ok: false; readonly failure: VideoFailure };

export type ChosenEncoders =
  | { readonly ok: true; readonly encoders: readonly [VideoEncoder, ...VideoEncoder[]] }
  | { readonly ok: false; readonly failure: VideoFailure };

/** Names that may be wanted. */
export const WANTED_ENCODERS: readonly string[] = [
  'auto',
  'h264',
  'vp8',
  ...VIDEO_ENCODERS.map(({ name }) => name),
];

/**
 * Hardware first, because it leaves the CPU to the robot; then H.264, which every browser decodes in hardware.
 *
 * @param wanted a codec, an encoder, or `auto`
 */
export function chooseEncoder(available: readonly AvailableEncoder[], wanted: string): ChosenEncoder {
  const chosen = chooseEncoders(available, wanted);
  return chosen.ok ? { ok: true, encoder: chosen.encoders[0] } : chosen;
}

/**
 * The first choice, and with `auto` also the best encoder of each other codec.
 *
 * @param wanted a codec, an encoder, or `auto`
 */
export function chooseEncoders(available: readonly AvailableEncoder[], wanted: string): ChosenEncoders {
  const fitting = VIDEO_ENCODERS.filter(
    ({ name, codec }) => wanted === 'auto' || wanted === codec || wanted === name,
  );
  const there = fitting.filter(({ name }) => available.some((each) => each.name === name));
  const [first] = there;
  if (first === undefined) return { ok: false, failure: noEncoder(available, fitting, wanted) };
  const others = VIDEO_CODECS.filter((codec) => codec !== first.codec && wanted === 'auto');
  const encoders = others.flatMap((codec) => there.find((each) => each.codec === codec) ?? []);
  return { ok: true, encoders: [first, ...encoders] };
}

function noEncoder(
  available: readonly AvailableEncoder[],
  fitting: readonly VideoEncoder[],
  wanted: string,
): VideoFailure {
  const there = available.map(({ name }) => name).filter((name) => WANTED_ENCODERS.includes(name));
  const said =
    fitting.length === 0
      ? `${wanted} is not one of ${WANTED_ENCODERS.join(', ')}`
      : `none of ${fitting.map(({ name }) => name).join(', ')} is there (there is ${there.join(', ') || 'none'})`;
  return videoFailure('no-encoder', said);
}

/**
 * Threads of an encoder in software. Each codes a slice of the same picture, which shortens its delay; half of the
 * cores stay free for what drives the robot.
 */
export function encoderThreads(cores: number): number {
  return Math.max(1, Math.min(4, Math.floor(cores / 2)));
}

/** The elements that must exist for it. */
export function neededElements({ name, codec, before }: VideoEncoder): string[] {
  const first = before === undefined ? [] : [before.split(' ', 1)[0]!];
  return codec === 'h264' ? [...first, name, 'h264parse'] : [...first, name];
}

/** `name=value`, separated by spaces, with nothing that ends an element. */
export const ENCODER_PROPERTIES = /^(?:[a-z0-9-]+=[A-Za-z0-9._:+-]+(?: |$))*$/;

/**
 * The encoder's part of the pipeline.
 *
 * @param extra further properties, which take precedence over ours
 */
export function encoderText(encoder: VideoEncoder, threads: number, extra = ''): string {
  const properties = encoder.properties.replaceAll('THREADS', String(threads));
  const own = `${encoder.name} name=farpoint-encoder ${properties}${extra === '' ? '' : ` ${extra}`}`;
  const before = encoder.before === undefined ? [] : [encoder.before];
  if (encoder.codec === 'vp8') return [...before, own, 'video/x-vp8'].join(' ! ');
  const profile = encoder.profile === undefined ? [] : [`video/x-h264,profile=${encoder.profile}`];
  return [
    ...before,
    own,
    ...profile,
    // Parameter sets before each key frame, whatever the encoder does.
    'h264parse config-interval=-1',
    'video/x-h264,stream-format=byte-stream,alignment=au',
  ].join(' ! ');
}
