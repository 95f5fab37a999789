/** The experiments of the telemetry thesis, by the figures in which it published them. */
import type { BenchCamera } from './camera-list.ts';

export interface CameraExperiment {
  /** The thesis' figure; `null`: a bit rate that it lists without a figure. */
  figure: number | null;
  name: string;
  cameras: readonly BenchCamera[];
  synchronised: boolean;
  /** What the thesis found; `null` without a figure. */
  found: string | null;
}

const small = { width: 960, height: 480 };
const medium = { width: 1024, height: 768 };
const large = { width: 1920, height: 1080 };

const two = [
  { ...medium, framesPerS: 30, kbitPerS: 512 },
  { ...medium, framesPerS: 30, kbitPerS: 512 },
];
const mixed = [
  { ...small, framesPerS: 60, kbitPerS: 512 },
  { ...large, framesPerS: 30, kbitPerS: 1024 },
];
const three = [...two, { ...medium, framesPerS: 30, kbitPerS: 512 }];

function one(size: typeof small, framesPerS: number, kbitPerS: number): BenchCamera[] {
  return [{ ...size, framesPerS, kbitPerS }];
}

export const CAMERA_EXPERIMENTS: readonly CameraExperiment[] = [
  ...[30, 60].map((rate) => ({
    figure: 13,
    name: `960×480, ${rate}/s, 512 kbit/s`,
    cameras: one(small, rate, 512),
    synchronised: true,
    found: '60/s is slightly later than 30/s',
  })),
  ...[30, 60].map((rate) => ({
    figure: 14,
    name: `1024×768, ${rate}/s, 2048 kbit/s`,
    cameras: one(medium, rate, 2048),
    synchronised: true,
    found: '60/s is slightly later than 30/s',
  })),
  {
    figure: 15,
    name: '1920×1080, 60/s, 1024 kbit/s',
    cameras: one(large, 60, 1024),
    synchronised: true,
    found: 'one core cannot encode it: latency grows without end',
  },
  {
    figure: 16,
    name: '2 × 1920×1080, 30/s, 2048 kbit/s',
    cameras: [...one(large, 30, 2048), ...one(large, 30, 2048)],
    synchronised: true,
    found: 'no bottleneck',
  },
  ...[
    { cameras: two, name: '2 × 1024×768, 30/s, 512 kbit/s', found: 'differ by more than 10 ms' },
    {
      cameras: mixed,
      name: '960×480, 60/s, 512 kbit/s and 1920×1080, 30/s, 1024 kbit/s',
      found: 'differ clearly',
    },
    { cameras: three, name: '3 × 1024×768, 30/s, 512 kbit/s', found: 'at times more than 300 ms apart' },
  ].flatMap((each, i) => [
    { ...each, figure: 17 + i, synchronised: false },
    {
      ...each,
      figure: 20 + i,
      synchronised: true,
      found: 'less than 1 ms apart; later by the buffer of 200 ms',
    },
  ]),
  ...[512, 1024, 2048, 4096].map((kbitPerS) => ({
    figure: null,
    name: `1024×768, 30/s, ${kbitPerS} kbit/s`,
    cameras: one(medium, 30, kbitPerS),
    synchronised: true,
    found: null,
  })),
];

/** A heading for people. */
export function experimentTitle({ figure, name, cameras, synchronised }: CameraExperiment): string {
  const what = figure === null ? 'bit rate' : `figure ${figure}`;
  return `${what}: ${name}${cameras.length === 1 || synchronised ? '' : ', not synchronised'}`;
}
