/** `pnpm bench cameras`: glass to glass of the robot's cameras, and how well they are in step. */
import { writeFileSync } from 'node:fs';
import { basename } from 'node:path';
import { availableEncoders, chooseEncoder } from '@farpoint/video';
import { benchOptions, option } from './bench-options.ts';
import { CAMERA_EXPERIMENTS, experimentTitle } from './camera-experiments.ts';
import { type BenchCamera, parseCameras } from './camera-list.ts';
import { plotCameras } from './camera-plot.ts';
import { type CameraRun, type CameraSetup, LINK_RTT_MS, runCameras } from './camera-run.ts';
import { parseShares } from './camera-shares.ts';
import { type Bench, type Cell, distributionCells, printJson, printTable } from './report.ts';
import { rounded } from './stats.ts';

const USAGE = `pnpm bench cameras [options]

Real robot, signaling and headless Chromium. Cameras with a common trigger send test pictures, encoded by GStreamer, with the
capture time drawn into each; the page reads it from what it shows, on every presentation. The page drives all the while.

  --cameras LIST      SIZE@FPS:KBPS of each camera, by default 1024x768@30:512 three times
  --sync on           or off: pictures are shown as they come
  --receiver native   or track or webcodecs: how the page receives; by default what suits the browser best
  --over loopback     or a capacity trace, CSV time_s,capacity_mbps, over a link with ${LINK_RTT_MS} ms of round trip
  --seconds 30        duration
  --encoder auto      as the robot chooses; or one that \`pnpm robot doctor\` lists
  --sound             the page hears a microphone, too
  --content plain     or noise, which takes any bit rate, so that all streams compete for the link
  --points 600        of each cloud beside them; \`all\`: the simulated camera's, as the link allows
  --cloud-fps 10      clouds a second
  --shares 2:1,1,1    how the operator divides the link: weights of the clouds and of each camera
  --canvas 160x90     of the point view, which is drawn in software
  --thesis            the experiments of the telemetry thesis, one after another, instead of --cameras and --sync
  --plot FILE.svg     latency over time, averaged per 5 s
  --json

glassToGlassMs: from capture to the end of the display frame that shows the picture. spreadMs: between the earliest and the
latest capture in a presentation; shareHalfInterval: no more than half an interval of the slowest camera.
cloudApartMs: between the newest capture of the cameras and of the cloud that are shown. addedBySyncMs: how long pictures that had arrived waited for others. dropped: pictures that
encoders skipped, and pictures that arrived and were not shown. commandDelayMs: from the page to the robot, beyond the link's
own delay. robotCpu, browserCpu: cores, encoders included. keyFrames: encoded during the measurement, all cameras together.`;

/** Of each cloud, without `all`. */
const POINTS = option.number(600, { least: 150 });

export const bench: Bench = {
  name: 'cameras',
  summary: 'glass to glass of several cameras, and how well they are in step',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, {
      cameras: option.text('1024x768@30:512,1024x768@30:512,1024x768@30:512'),
      sync: option.choice('on', ['on', 'off']),
      receiver: option.text(),
      over: option.text('loopback'),
      seconds: option.number(30, { least: 1 }),
      encoder: option.text('auto'),
      content: option.choice('plain', ['plain', 'noise']),
      points: option.of<number | null, number>(600, `all or ${POINTS.allowed}`, (text) =>
        text === 'all' ? null : POINTS.read(text),
      ),
      cloudFps: option.number(10, { least: 1 }),
      shares: option.text(),
      sound: option.flag,
      canvas: option.text('160x90'),
      thesis: option.flag,
      plot: option.text(),
    });
    const { seconds, canvas, content, sound, thesis, points, plot } = options;
    const cameras = parseCameras(options.cameras);
    const setup: CameraSetup = {
      cameras,
      synchronised: options.sync === 'on',
      canvas,
      encoder: await encoderOf(options.encoder),
      content,
      sound,
      receiver: options.receiver ?? null,
      trace: options.over === 'loopback' ? null : options.over,
      seconds,
      points,
      cloudsPerS: options.cloudFps,
      shares: options.shares === undefined ? null : parseShares(options.shares, cameras.length),
    };
    const over = setup.trace === null ? 'loopback' : basename(setup.trace);
    const common = { bench: 'cameras', over, encoder: setup.encoder, seconds: setup.seconds };
    const runs = thesis
      ? await runThesis({ ...setup, shares: null })
      : [{ title: options.cameras, found: null, cameras, run: await runCameras(setup, console.error) }];
    if (!thesis) runs.forEach(print);
    if (plot !== undefined) {
      const title = 'Latency of cameras, from capture to display';
      writeFileSync(plot, plotCameras(title, `${setup.encoder}, over ${over}`, runs));
    }
    if (!options.json) return;
    const results = runs.map(({ title, cameras, run }) => ({ title, cameras, ...figuresOf(run) }));
    printJson(thesis ? { ...common, runs: results } : { ...common, sync: options.sync, ...results[0] });
  },
};

/** @throws {Error} if there is none */
async function encoderOf(wanted: string): Promise<string> {
  const chosen = chooseEncoder((await availableEncoders()).encoders, wanted);
  if (!chosen.ok) throw new Error(`--encoder: ${chosen.failure.sentence}`);
  return chosen.encoder.name;
}

interface TitledRun {
  title: string;
  /** What the thesis found. */
  found: string | null;
  cameras: readonly BenchCamera[];
  run: CameraRun;
}

/** Prints each result as soon as it is there. */
async function runThesis(setup: CameraSetup): Promise<TitledRun[]> {
  const runs: TitledRun[] = [];
  for (const experiment of CAMERA_EXPERIMENTS) {
    const { cameras, synchronised, found } = experiment;
    const title = experimentTitle(experiment);
    console.error(`${runs.length + 1} of ${CAMERA_EXPERIMENTS.length}: ${title}`);
    const run = await runCameras({ ...setup, cameras, synchronised }, console.error);
    const titled = { title, found, cameras, run };
    print(titled);
    runs.push(titled);
  }
  return runs;
}

function print({ title, found, cameras, run }: TitledRun): void {
  console.log(`\n${title}`);
  if (found !== null) console.log(`The thesis: ${found}.`);
  printTable(
    ['camera', 'frames/s', 'dropped', 'glass to glass p50', 'p95', 'p99', 'max'],
    cameras.map(({ width, height, framesPerS, kbitPerS }, i) => [
      `${width}×${height}, ${framesPerS}/s, ${kbitPerS} kbit/s`,
      (run.framesPerSecond[i] ?? 0).toFixed(1),
      run.dropped[i],
      ...distributionCells(rounded(run.glassToGlassMs[i] as CameraRun['spreadMs'], 1)),
    ]),
  );
  const columns = [...presentationColumns(run), ...programColumns(run)];
  printTable(
    columns.map(([heading]) => heading),
    [columns.map(([, cell]) => cell)],
  );
  if (run.shares !== null)
    printTable(
      ['stream', 'asked', 'seen'],
      run.shares.map(({ stream, asked, seen }) => [stream, asked, seen]),
    );
}

type Column = readonly [heading: string, cell: Cell];

/** Columns about pictures and clouds that were shown at once. */
function presentationColumns(run: CameraRun): Column[] {
  const [spread, cloud] = [rounded(run.spreadMs, 2), rounded(run.cloudApartMs, 1)];
  return [
    ['spread p50', spread.p50],
    ['p99', spread.p99],
    ['max', spread.max],
    ['under 1 ms', percent(run.share1Ms)],
    ['half interval', percent(run.shareHalfInterval)],
    ['waited p50', run.addedBySyncMs?.p50],
    ['cloud apart p50', cloud.p50],
    ['p95', cloud.p95],
    ['half interval', percent(run.cloudHalfInterval)],
  ];
}

/** Columns about the programs, the link and the commands. */
function programColumns(run: CameraRun): Column[] {
  const command = rounded(run.commandDelayMs, 1);
  return [
    ['robot, cores', run.robotCpu],
    ['browser', run.browserCpu],
    ['queue p95', run.queueMs === null ? '–' : rounded(run.queueMs, 1).p95],
    ['commands', run.commands],
    ['later p50', command.p50],
    ['p99', command.p99],
    ['max', command.max],
    ['refused', run.commandsRefused],
    ['key frames', run.keyFrames],
    ['receiver', run.receiver],
  ];
}

function percent(share: number): string {
  return `${(share * 100).toFixed(1)} %`;
}

/** What `--json` prints of a run; latency is measured in no other way than glass to glass. */
function figuresOf(run: CameraRun) {
  const {
    glassToGlassMs: latencies,
    spreadMs,
    cloudApartMs,
    commandDelayMs,
    queueMs,
    series,
    ...figures
  } = run;
  const glassToGlassMs = latencies.map((each) => rounded(each, 1));
  return {
    glassToGlassMs,
    latencyMs: glassToGlassMs,
    spreadMs: rounded(spreadMs, 2),
    cloudApartMs: rounded(cloudApartMs, 1),
    commandDelayMs: rounded(commandDelayMs, 1),
    queueMs: queueMs === null ? null : rounded(queueMs, 1),
    ...figures,
    series: series.map(({ s, ms }) => ({ s, ms: ms.map((value) => Number(value.toFixed(1))) })),
  };
}
