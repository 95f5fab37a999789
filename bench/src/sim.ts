/** `pnpm bench sim`: a kernel benchmark of the simulated robot and its camera. */
import { parseArgs } from 'node:util';
import { zeroTwist } from '@farpoint/protocol';
import { Simulation } from '@farpoint/sim';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench sim [--frames 300] [--fps 30] [--width 480] [--height 480] [--seed 1] [--json]

Kernel benchmark, in one process. Drives the simulated robot through the hall of the office and renders --frames frames,
--fps per simulated second; cores is the processor load of doing this in real time.`;

const WARM_UP = 60;

interface Options {
  frames: number;
  fps: number;
  width: number;
  height: number;
  seed: number;
  json: boolean | undefined;
}

export const bench: Bench = {
  name: 'sim',
  summary: 'kernel: time of a frame of the simulated depth camera, and the cores it takes',
  async run(argv) {
    const options = readOptions(argv);
    if (options === null) return;
    const { seed, width, height } = options;
    const simulation = await Simulation.create({ seed, camera: { width, height } });
    const times = measure(simulation, options);
    simulation.close();
    report(options, times);
  },
};

/** @returns `null` if only the usage was requested @throws {Error} naming the option */
function readOptions(argv: string[]): Options | null {
  const { values } = parseArgs({
    args: argv,
    options: {
      frames: { type: 'string', default: '300' },
      fps: { type: 'string', default: '30' },
      width: { type: 'string', default: '480' },
      height: { type: 'string', default: '480' },
      seed: { type: 'string', default: '1' },
      json: { type: 'boolean' },
      help: { type: 'boolean' },
    },
  });
  if (values.help) {
    console.log(USAGE);
    return null;
  }
  return {
    frames: numberOption('frames', values.frames, 1),
    fps: numberOption('fps', values.fps, 1),
    width: numberOption('width', values.width, 16),
    height: numberOption('height', values.height, 16),
    seed: numberOption('seed', values.seed),
    json: values.json,
  };
}

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
