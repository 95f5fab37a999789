/** The options of `pnpm bench link`. */
import { benchOptions, option } from './bench-options.ts';

export const LINK_USAGE = `pnpm bench link [options]

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
const DRAW_EVERY = { points64: 8, auto: 192 } as const;

export type LinkOptions = ReturnType<typeof readLinkOptions>;

/** @throws {Error} naming the option */
export function readLinkOptions(argv: string[]) {
  const { rateMbps, ...options } = benchOptions(argv, {
    rateMbps: option.number(undefined, { least: 0.1 }),
    trace: option.text(),
    rttMs: option.number(42.4),
    jitterMs: option.number(0),
    loss: option.number(0),
    burstLoss: option.number(0),
    queueMs: option.number(100),
    cross: option.text(),
    robots: option.number(1, { least: 1 }),
    sensors: option.number(1, { least: 1, most: 8, whole: true }),
    seconds: option.number(30, { least: 6 }),
    mode: option.choice('points64', ['points64', 'auto']),
    drawEvery: option.number(undefined, { least: 1 }),
    fps: option.number(60, { least: 1 }),
    plan: option.text('latency'),
    rateControl: option.text('adaptive'),
    canvas: option.text('160x90'),
    plot: option.text(),
    keep: option.text(),
  });
  if (options.trace !== undefined && rateMbps !== undefined)
    throw new Error('--rate-mbps and --trace exclude each other');
  const { drawEvery = DRAW_EVERY[options.mode] } = options;
  return { ...options, rateMbps: rateMbps ?? 41.44, drawEvery };
}
