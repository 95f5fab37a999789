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

export const bench: Bench = {
  name: 'sim',
  summary: 'kernel: time of a frame of the simulated depth camera, and the cores it takes',
  async run(argv) {
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
    if (values.help) return console.log(USAGE);
    const frames = numberOption('frames', values.frames, 1);
    const fps = numberOption('fps', values.fps, 1);
    const width = numberOption('width', values.width, 16);
    const height = numberOption('height', values.height, 16);
    const seed = numberOption('seed', values.seed);

    const simulation = await Simulation.create({ seed, camera: { width, height } });
    const command = zeroTwist();
    const renderTimes: number[] = [];
    const stepTimes: number[] = [];
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
      stepTimes.push(stepped - begin);
      renderTimes.push(end - stepped);
      if (frame === frames - 1) invalid = depth.reduce((count, z) => (z > 0 ? count : count + 1), 0);
    }
    const { user, system } = process.cpuUsage(processor);
    simulation.close();

    const render = rounded(distribution(renderTimes));
    const step = rounded(distribution(stepTimes));
    const cores = Number((((user + system) / 1e6 / frames) * fps).toFixed(3));
    const invalidShare = Number((invalid / (width * height)).toFixed(4));
    console.log(`${frames} frames of ${width} × ${height} (kernel: one process, as fast as it goes)`);
    printTable(
      ['ms', 'p50', 'p95', 'p99', 'max'],
      [
        ['render', ...distributionCells(render)],
        ['step', ...distributionCells(step)],
      ],
    );
    console.log(`${cores} cores at ${fps} frames/s; ${(100 * invalidShare).toFixed(1)} % of pixels invalid`);
    if (values.json) {
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
  },
};
