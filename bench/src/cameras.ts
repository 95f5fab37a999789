/** `pnpm bench cameras`: glass to glass of the robot's cameras, and how well they are in step. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { parseArgs } from 'node:util';
import { availableEncoders } from '@farpoint/video';
import { type BenchCamera, parseCameras } from './camera-list.ts';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { queueQuantiles } from './link-analysis.ts';
import { readUplink, scrape } from './link-run.ts';
import { startLiveStack } from './live-stack.ts';
import { presentationFigures } from './presentation-figures.ts';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { rounded } from './stats.ts';

const USAGE = `pnpm bench cameras [options]

Real robot, signaling and headless Chromium. Cameras with a common trigger send test pictures, encoded by GStreamer, with the
capture time drawn into each; the page reads it from what it shows, on every presentation.

  --cameras LIST      SIZE@FPS:KBPS of each camera, by default 1024x768@30:512 three times
  --sync on           or off: pictures are shown as they come
  --receiver native   or track or webcodecs: how the page receives; by default what suits the browser best
  --over loopback     or a capacity trace, CSV time_s,capacity_mbps, over a link with 42.4 ms of round trip
  --seconds 30        duration
  --encoder vp8enc    or another one that \`pnpm robot doctor\` lists
  --points 600        of the cloud beside them, 10 times a second
  --canvas 160x90     of the point view, which is drawn in software
  --json

glassToGlassMs: from capture to the end of the display frame that shows the picture. spreadMs: between the earliest and the
latest capture in a presentation. addedBySyncMs: how long pictures that had arrived waited for others. dropped: pictures that
encoders skipped, and pictures that arrived and were not shown. robotCpu, browserCpu: cores, encoders included.
keyFrames: encoded during the measurement, all cameras together.`;

const ROBOT = 'sim-1';
const WARM_UP_MS = 5000;
const MOST_PRESENTATIONS = 60_000;
const SETTLE_MS = 500;

export const bench: Bench = {
  name: 'cameras',
  summary: 'glass to glass of several cameras, and how well they are in step',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        cameras: { type: 'string', default: '1024x768@30:512,1024x768@30:512,1024x768@30:512' },
        sync: { type: 'string', default: 'on' },
        receiver: { type: 'string' },
        over: { type: 'string', default: 'loopback' },
        seconds: { type: 'string', default: '30' },
        encoder: { type: 'string', default: 'vp8enc' },
        points: { type: 'string', default: '600' },
        canvas: { type: 'string', default: '160x90' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const cameras = parseCameras(values.cameras);
    const seconds = numberOption('seconds', values.seconds, 1);
    const points = numberOption('points', values.points, 150);
    if (values.sync !== 'on' && values.sync !== 'off') throw new Error('--sync is on or off');
    await availableEncoders();
    const folder = mkdtempSync(join(tmpdir(), 'farpoint-cameras-'));
    const [config, linkFile] = [join(folder, 'farpoint.yaml'), join(folder, 'link.jsonl')];
    writeFileSync(config, JSON.stringify({ robot: { videos: cameraOptions(cameras, values.encoder) } }));
    const traced = values.over !== 'loopback';
    const rate = traced ? [] : ['--rate-control', 'fixed', '--bitrate-mbps', '50'];
    const live = await startLiveStack({
      robot: {
        id: ROBOT,
        name: 'Robot with cameras',
        args: [
          ...['--config', config, '--sim-size', '64', '--fps', '10', '--mode', 'points64'],
          ...['--max-points', String(points), ...rate],
        ],
      },
      canvas: values.canvas,
      query: `barcode=1&sync=${values.sync === 'on' ? 1 : 0}&video=${values.receiver ?? ''}`,
      ...(traced
        ? {
            connectAtMbps: 20,
            link: {
              args: ['--up-trace', values.over, '--down-rate-mbps', '50', '--rtt-ms', '42.4'],
              statsFile: linkFile,
              env: { FARPOINT_LOG_LEVEL: 'warn' },
            },
          }
        : {}),
      log: (line) => console.error(line),
    });
    try {
      const { page, stack, link, browserPid } = live;
      const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));
      link?.tell({ type: 'reset' });
      await wait(WARM_UP_MS);
      const pid = stack.robot(ROBOT).pid;
      console.error(`${seconds} s`);
      const skipped = () => readSkipped(stack.robotAdminUrl(ROBOT), cameras.length);
      const [skippedBefore, keysBefore] = [await skipped(), await readKeyFrames(stack.robotAdminUrl(ROBOT))];
      const [fromMs, cpuBefore] = [performance.now(), cpuSecondsOfTree(pid)];
      const browserBefore = cpuSecondsOfTree(browserPid);
      await page.evaluate((capacity) => {
        window.farpoint.resetStats();
        window.farpoint.recordPresentations(capacity);
      }, MOST_PRESENTATIONS);
      await wait(seconds * 1000);
      const robotCpu = coresBetween(cpuBefore, cpuSecondsOfTree(pid), performance.now() - fromMs);
      const browserCpu = coresBetween(
        browserBefore,
        cpuSecondsOfTree(browserPid),
        performance.now() - fromMs,
      );
      const skippedAfter = await skipped();
      const keyFrames = (await readKeyFrames(stack.robotAdminUrl(ROBOT))) - keysBefore;
      const { rows, stats } = await page.evaluate(() => ({
        rows: window.farpoint.recordedPresentations(),
        stats: window.farpoint.stats().videos,
      }));
      await wait(SETTLE_MS);
      const figures = presentationFigures(rows, cameras.length);
      const unshown = stats.sources
        .filter(({ source }) => source.startsWith('video:'))
        .map(({ drops }) => Object.values(drops).reduce((sum, count) => sum + count, 0));
      const dropped = cameras.map(
        (_, i) => (skippedAfter[i] ?? 0) - (skippedBefore[i] ?? 0) + (unshown[i] ?? 0),
      );
      const glassToGlassMs = figures.glassToGlassMs.map((each) => rounded(each, 1));
      printTable(
        ['camera', 'frames/s', 'dropped', 'glass to glass p50', 'p95', 'p99', 'max'],
        cameras.map(({ width, height, framesPerS, kbitPerS }, i) => [
          `${width}×${height}, ${framesPerS}/s, ${kbitPerS} kbit/s`,
          (figures.framesPerSecond[i] ?? 0).toFixed(1),
          dropped[i],
          ...distributionCells(glassToGlassMs[i] as (typeof glassToGlassMs)[0]),
        ]),
      );
      const spreadMs = rounded(figures.spreadMs, 2);
      const addedBySyncMs = stats.heldMs;
      const queueMs = traced ? rounded(queueQuantiles(readUplink(linkFile)), 1) : null;
      printTable(
        [
          ...['receiver', 'synchronised', 'spread p50', 'p99', 'max', 'under 1 ms', 'waited p50'],
          ...['robot, cores', 'browser, cores', 'key frames', 'queue p95'],
        ],
        [
          [
            stats.receiver,
            values.sync,
            spreadMs.p50,
            spreadMs.p99,
            spreadMs.max,
            `${(figures.share1Ms * 100).toFixed(1)} %`,
            addedBySyncMs?.p50,
            robotCpu,
            browserCpu,
            keyFrames,
            queueMs?.p95,
          ],
        ],
      );
      if (values.json) {
        printJson({
          ...{ bench: 'cameras', cameras, sync: values.sync, seconds, encoder: values.encoder },
          receiver: stats.receiver,
          over: traced ? basename(values.over) : 'loopback',
          // Latency is measured in no other way.
          ...{ glassToGlassMs, latencyMs: glassToGlassMs, spreadMs, share1Ms: figures.share1Ms },
          ...{ addedBySyncMs, dropped, framesPerSecond: figures.framesPerSecond, queueMs },
          ...{ robotCpu, browserCpu, keyFrames },
          ...{ unreadable: figures.unreadable, presentations: rows.length },
        });
      }
    } finally {
      await live.close();
      rmSync(folder, { recursive: true, force: true });
    }
  },
};

function cameraOptions(cameras: readonly BenchCamera[], encoder: string) {
  const patterns = ['pinwheel', 'ball', 'smpte'];
  return cameras.map(({ width, height, framesPerS, kbitPerS }, i) => ({
    name: cameraName(i),
    source: { kind: 'test', pattern: patterns[i % patterns.length], width, height, framesPerS },
    ...{ encoder, width, height, framesPerS, kbitPerS },
  }));
}

/** Pictures that encoders have skipped so far, by camera. */
async function readSkipped(adminUrl: string, cameras: number): Promise<number[]> {
  const counts = await scrape(adminUrl, 'farpoint_robot_video_frames_skipped_total', 'camera');
  return Array.from({ length: cameras }, (_, i) => counts[cameraName(i)] ?? 0);
}

/** Key frames encoded so far, all cameras together. */
async function readKeyFrames(adminUrl: string): Promise<number> {
  const counts = await scrape(adminUrl, 'farpoint_robot_video_key_frames_total', 'camera');
  return Object.values(counts).reduce((sum, count) => sum + count, 0);
}

function cameraName(index: number): string {
  return `Camera ${index + 1}`;
}
