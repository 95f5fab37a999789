/** The options of `pnpm bench link`. */
import { parseArgs } from 'node:util';
import { numberOption } from './report.ts';

const USAGE = `pnpm bench link [options]

Real robot (simulated office), signaling and headless Chromium; all packets between robot and browser pass an emulated link.
The operator drives in circles and repeatedly tests the latency: from an input event to the end of the display frame that
shows the whole green cloud (mtpMs) or its first points (mtpFirstMs). Figures cover the time after the first 5 s.

  --rate-mbps 41.44   capacity, both ways, 10^6 bit/s on the wire
  --trace FILE        capacity from the robot over time, CSV time_s,capacity_mbps; the other direction has 50 Mbit/s, and no
                      service while the trace has none
  --rtt-ms 42.4       propagation delay, both ways together
  --jitter-ms 0  --loss 0  --burst-loss 0  --queue-ms 100
  --cross KIND        a competing flow from the robot's side: cubic, reno
  --robots 1          this many robots stream over the same link, each to its own page; the first one is measured
  --sensors 1         cloud sensors of the robot, all watched: its camera, and LiDARs; latencies of the motion are the camera's
  --seconds 30        duration; a trace restarts when the measurement starts
  --mode points64     points64, or auto: the best format that both sides support, with the whole cloud if the rate allows
  --draw-every N      draw every N-th point; all are decoded. Without a GPU, the benchmark would otherwise measure the
                      drawing. 8 for points64, 192 for auto: about 1,000 points a display frame; 1 draws all
  --fps 60            maximum frames a second to request from the camera
  --plan latency      or paper: every frame, points by the paper's equations 2 and 3
  --rate-control adaptive   or fixed
  --canvas 160x90     small, because it is drawn in software: the stream is to be measured, not the renderer
  --plot FILE.svg     capacity, estimate, delivered rate, latency, points and frames over time
  --json`;

/** About a thousand points per display frame, for a sample and for a whole cloud. */
const DRAW_EVERY = { points64: '8', auto: '192' } as const;

export type LinkOptions = NonNullable<ReturnType<typeof readLinkOptions>>;

/** @returns `null` if only the usage was requested @throws {Error} naming the option */
export function readLinkOptions(argv: string[]) {
  const { values } = parseArgs({
    args: argv,
    options: {
      'rate-mbps': { type: 'string' },
      trace: { type: 'string' },
      'rtt-ms': { type: 'string', default: '42.4' },
      'jitter-ms': { type: 'string', default: '0' },
      loss: { type: 'string', default: '0' },
      'burst-loss': { type: 'string', default: '0' },
      'queue-ms': { type: 'string', default: '100' },
      cross: { type: 'string' },
      robots: { type: 'string', default: '1' },
      sensors: { type: 'string', default: '1' },
      seconds: { type: 'string', default: '30' },
      mode: { type: 'string', default: 'points64' },
      'draw-every': { type: 'string' },
      fps: { type: 'string', default: '60' },
      plan: { type: 'string', default: 'latency' },
      'rate-control': { type: 'string', default: 'adaptive' },
      canvas: { type: 'string', default: '160x90' },
      plot: { type: 'string' },
      keep: { type: 'string' },
      json: { type: 'boolean' },
      help: { type: 'boolean' },
    },
  });
  if (values.help) {
    console.log(USAGE);
    return null;
  }
  if (values.trace !== undefined && values['rate-mbps'] !== undefined)
    throw new Error('--rate-mbps and --trace exclude each other');
  if (values.mode !== 'points64' && values.mode !== 'auto')
    throw new Error(`--mode is \`${values.mode}\`, not points64 or auto`);
  const rateMbps = numberOption('rate-mbps', values['rate-mbps'] ?? '41.44', 0.1);
  const seconds = numberOption('seconds', values.seconds, 6);
  const drawEvery = numberOption('draw-every', values['draw-every'] ?? DRAW_EVERY[values.mode], 1);
  const robots = numberOption('robots', values.robots, 1);
  const fps = numberOption('fps', values.fps, 1);
  const sensors = numberOption('sensors', values.sensors, 1);
  if (!Number.isInteger(sensors) || sensors < 1 || sensors > 8)
    throw new Error(`--sensors is \`${values.sensors}\`, not a number from 1 to 8`);
  const { mode } = values;
  return { values: { ...values, mode }, rateMbps, seconds, drawEvery, robots, fps, sensors };
}
