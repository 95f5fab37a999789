/** `pnpm bench sim`: a kernel benchmark of the simulated robot and its camera. */
import { zeroTwist } from '@farpoint/protocol';
import { Simulation } from '@farpoint/sim';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench sim [--frames 300] [--fps 30] [--width 480] [--height 480] [--seed 1] [--json]

Kernel benchmark, in one process. Drives the simulated robot through the hall of the office and renders --frames frames,
--fps per simulated second; cores is the processor load of doing this in real time.`;

const WARM_UP = 60;

const OPTIONS = {
  frames: option.number(300, { least: 1 }),
  fps: option.number(30, { least: 1 }),
  width: option.number(480, { least: 16 }),
  height: option.number(480, { least: 16 }),
  seed: option.number(1),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'sim',
  summary: 'kernel: time of a frame of the simulated depth camera, and the cores it takes',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const { seed, width, height } = options;
    const simulation = await Simulation.create({ seed, camera: { width, height } });
    const times = measure(simulation, options);
    simulation.close();
    report(options, times);
  },
};

interface Times {
  /** Times of each frame, ms. */
  render: number[];
  step: number[];
  /** Processor time of all frames together, s. */
  processor: number;
  /** Pixels of the last frame without depth. */
  invalid: number;
}

/** Drives the robot through the hall, and times each frame. */
function measure(simulation: Simulation, { frames, fps }: Options): Times {
  const command = zeroTwist();
  const render: number[] = [];
  const step: number[] = [];
  let invalid = 0;
  let processor = process.cpuUsage();
  for (let frame = -WARM_UP; frame < frames; frame++) {
    if (frame === 0) processor = process.cpuUsage();
    // Back and forth, while turning.
    command.linear.x = frame % 240 < 120 ? 0.5 : -0.5;
    command.angular.z = frame % 60 < 30 ? 0.3 : -0.3;
    simulation.setCommand(command);
    const begin = performance.now();
    simulation.step(1 / fps);
    const stepped = performance.now();
    const { depth } = simulation.renderFrame({ points: false });
    const end = performance.now();
    if (frame < 0) continue;
    step.push(stepped - begin);
    render.push(end - stepped);
    if (frame === frames - 1) invalid = depth.reduce((count, z) => (z > 0 ? count : count + 1), 0);
  }
  const { user, system } = process.cpuUsage(processor);
  return { render, step, processor: (user + system) / 1e6, invalid };
}

function report({ frames, fps, width, height, json }: Options, times: Times): void {
  const render = rounded(distribution(times.render));
  const step = rounded(distribution(times.step));
  const cores = Number(((times.processor / frames) * fps).toFixed(3));
  const invalidShare = Number((times.invalid / (width * height)).toFixed(4));
  console.log(`${frames} frames of ${width} × ${height} (kernel: one process, as fast as it goes)`);
  printTable(
    ['ms', 'p50', 'p95', 'p99', 'max'],
    [
      ['render', ...distributionCells(render)],
      ['step', ...distributionCells(step)],
    ],
  );
  console.log(`${cores} cores at ${fps} frames/s; ${(100 * invalidShare).toFixed(1)} % of pixels invalid`);
  if (!json) return;
  printJson({
    bench: 'sim',
    width,
    height,
    frames,
    fps,
    renderMsP50: render.p50,
    renderMsP95: render.p95,
    cores,
    invalidShare,
    renderMs: render,
    stepMs: step,
  });
}
