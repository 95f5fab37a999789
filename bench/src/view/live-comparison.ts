/** What the real robot and the real page make of a rate: with packets' own colours, and with a video that paints. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';
import { driveInCircles } from '../drive-in-circles.ts';
import { monotonicMs, readRobotSamples } from '../link-run.ts';
import { startLiveStack } from '../live-stack.ts';
import { printJson, printTable } from '../report.ts';
import type { ComparisonOptions } from './colour-comparison.ts';
import { type Painting, watchPainting } from './painting-watch.ts';

const COARSE = 'video, coarse packets';
/** Of the page's address. */
const MODES = [
  { name: 'packets', video: false, query: 'surface=1' },
  { name: 'packets, video shown', video: true, query: 'surface=1&paint=0' },
  { name: 'video', video: true, query: 'surface=1&paint=1' },
  { name: COARSE, video: true, query: 'surface=1&paint=1&coarse=1' },
] as const;

interface LiveOutcome extends Painting {
  /** Clouds captured and coded per second. */
  framesPerS: number;
  /** Of those, clouds of which every point was coded. */
  wholePerS: number;
  /** Of the clouds, the share with coarse colours. */
  coarse: number;
  /** What the page drew. */
  drawnPerS: number;
  /** On the wire, all streams, headers included, Mbit/s. */
  mbps: number;
  videoMbps: number;
  /** Of clouds, as they arrive. */
  bitsPerPoint: number;
}

const ROBOT = 'sim-1';
/** Of the depth camera and its video, pixels. */
const SIDE = 480;
/** Small, because it is drawn in software: the stream is measured, not the renderer. */
const CANVAS = '160x160';
const RTT_MS = 42.4;
/** Until the rates have settled and the page has said what it paints. */
const WARM_UP_MS = 15_000;

/** Prints a row for each mode. @throws {Error} without GStreamer */
export async function compareLive(options: ComparisonOptions): Promise<void> {
  const outcomes: Record<string, LiveOutcome> = {};
  for (const mode of MODES) {
    console.error(`${mode.name} …`);
    outcomes[mode.name] = await measured(options, mode);
  }
  printTable(
    [
      ...['', 'clouds/s', 'whole/s', 'coarse', 'drawn/s', 'bits a point', 'Mbit/s', 'video Mbit/s'],
      ...['painted', 'shown', 'claimed', 'cloud age ms', 'held ms', 'picture age ms'],
    ],
    Object.entries(outcomes).map(([name, outcome]) => {
      const { framesPerS, wholePerS, coarse, drawnPerS, bitsPerPoint, mbps, videoMbps } = outcome;
      const { painted, shown, claimed, cloudAgeMs, heldMs, pictureAgeMs } = outcome;
      return [
        ...[name, framesPerS, wholePerS, coarse, drawnPerS, bitsPerPoint, mbps, videoMbps],
        ...[painted, shown, claimed, cloudAgeMs, heldMs, pictureAgeMs],
      ];
    }),
  );
  for (const [name, { states, pictures }] of Object.entries(outcomes))
    console.log(`${name}: ${JSON.stringify(states)}, pictures ${JSON.stringify(pictures)}`);
  const ratio = (outcomes[COARSE]?.wholePerS ?? 0) / (outcomes.packets?.wholePerS ?? 0);
  console.log(`the whole depth comes ${ratio.toFixed(2)} times as often as with packets' colours`);
  if (options.json) printJson({ bench: 'view', comparison: 'live-colour', ...options, ...outcomes });
}

async function measured(options: ComparisonOptions, mode: (typeof MODES)[number]): Promise<LiveOutcome> {
  const { rateMbps, loss, framesPerSecond, videoMbps, seconds } = options;
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-colours-'));
  const [config, stats] = ['farpoint.yaml', 'stats.jsonl'].map((name) => join(folder, name)) as [
    string,
    string,
  ];
  const source = { kind: 'sim', width: SIDE, height: SIDE, framesPerS: framesPerSecond };
  const camera = {
    ...{ name: 'Depth camera', ofCloud: true, source, framesPerS: framesPerSecond },
    ...{ width: SIDE, height: SIDE, kbitPerS: Math.round(videoMbps * 1000) },
  };
  writeFileSync(config, JSON.stringify({ robot: { videos: mode.video ? [camera] : [] } }));
  const live = await startLiveStack({
    robot: {
      id: ROBOT,
      name: 'Robot',
      args: [
        '--config',
        config,
        '--stats',
        stats,
        '--sim-size',
        String(SIDE),
        '--fps',
        String(framesPerSecond),
      ],
    },
    ...{ canvas: CANVAS, query: mode.query },
    link: {
      args: ['--rate-mbps', String(rateMbps), '--rtt-ms', String(RTT_MS), '--loss', String(loss)],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    },
    log: (line) => console.error(line),
  });
  try {
    const { page, stack } = live;
    const counts = async () => {
      const metrics = await totals(`${stack.robotAdminUrl(ROBOT)}/metrics`);
      const sent = readRobotSamples(stats).at(-1);
      const { framesDrawn, pointsDrawn, bytesReceived } = await page.evaluate(() => window.farpoint.stats());
      return { ...metrics, atMs: monotonicMs(), sent, framesDrawn, pointsDrawn, bytesReceived };
    };
    await wait(WARM_UP_MS);
    const before = await counts();
    const painting = await watchPainting(page, () =>
      page.evaluate(driveInCircles, { ms: seconds * 1000, forward: 0.3 }),
    );
    const after = await counts();
    const tookS = (after.atMs - before.atMs) / 1000;
    const per = (
      name: 'frames' | 'whole' | 'coarse' | 'videoBytes' | 'framesDrawn' | 'pointsDrawn' | 'bytesReceived',
    ) => after[name] - before[name];
    const sentS = ((after.sent?.timeMs ?? 0) - (before.sent?.timeMs ?? 0)) / 1000;
    const mbps = (((after.sent?.bytesSent ?? 0) - (before.sent?.bytesSent ?? 0)) * 8) / sentS / 1e6;
    const video = (per('videoBytes') * 8) / tookS / 1e6;
    const round = (value: number, digits = 2) => Number(value.toFixed(digits));
    return {
      framesPerS: round(per('frames') / tookS, 1),
      wholePerS: round(per('whole') / tookS, 1),
      coarse: round(per('coarse') / per('frames')),
      drawnPerS: round(per('framesDrawn') / tookS, 1),
      mbps: round(mbps),
      videoMbps: round(video),
      bitsPerPoint: round((per('bytesReceived') * 8) / per('pointsDrawn')),
      ...painting,
      painted: round(painting.painted),
      shown: round(painting.shown),
      claimed: round(painting.claimed),
    };
  } finally {
    await live.close();
    rmSync(folder, { recursive: true, force: true });
  }
}

async function totals(url: string) {
  const text = await (await fetch(url)).text();
  const sum = (name: string) => {
    let total = 0;
    for (const [, value] of text.matchAll(
      new RegExp(`^farpoint_robot_${name}(?:\\{[^}]*\\})? (\\S+)$`, 'gm'),
    )) {
      total += Number(value);
    }
    return total;
  };
  return {
    ...{ frames: sum('frames_captured_total'), whole: sum('frames_whole_total') },
    ...{ coarse: sum('frames_coarse_total'), videoBytes: sum('video_bytes_total') },
  };
}
