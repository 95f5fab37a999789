/**
 * `pnpm bench recording`: what recording costs the robot, whether its memory use stays constant, and whether the
 * recording is complete.
 */
import { readFileSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { processFolder } from '@farpoint/local-stack';
import { MAX_VIDEOS } from '@farpoint/protocol';
import { openRecording } from '@farpoint/recording';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import {
  CAMERA,
  encodedVideos,
  NOTHING_ENCODED,
  type RecordedFrame,
  recordedVideo,
  videoArgs,
} from './recorded-videos.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { buildSharedMemory, type LayoutResult, measure, type ShmRun } from './shm-run.ts';

const USAGE = `pnpm bench recording [--size 480] [--fps 30] [--seconds 60] [--mbps 20] [--pictures 0] [--videos 0] [--encoder x264enc] [--compression none] [--folder FOLDER] [--json]

A camera process writes size × size points --fps times a second to shared memory. The robot sends them to an operator, first
without a recording, then while recording everything: all clouds as captured (16 bytes a point) and as sent, and all
other topics; with --pictures N also the camera's picture N times a second, as sent to the operator; with
--videos N also N cameras with test pictures, 640×480 at 30/s and 1500 kbit/s, encoded by --encoder and watched by the operator.
Lost frames of a video: gaps in the capture times in the file. Main: the robot's main thread, which drives and sends.
Latency: from when the camera starts to write a frame until the robot has its packets ready. Memory: of the robot process, in
the first and the last fifth of the run. Afterwards the file is read back and every message is counted.`;

const OPTIONS = {
  size: option.number(480, { least: 16 }),
  fps: option.number(30, { least: 1 }),
  seconds: option.number(60, { least: 5 }),
  mbps: option.number(20, { least: 1 }),
  /** Pictures a second; 0 without. */
  pictures: option.number(0),
  videos: option.number(0, { most: MAX_VIDEOS, whole: true }),
  encoder: option.text('x264enc'),
  compression: option.text('none'),
  /** The session's own folder is made in it. */
  folder: option.text(tmpdir()),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'recording',
  summary: 'recording a session: added latency, memory over time, a count of every message',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    buildSharedMemory();
    const folder = processFolder(options.folder);
    const path = join(folder, 'session.mcap');
    const runs = await measureBoth(options, folder, path);
    const file = await readBack(path);
    const result = figuresOf(options, runs, file, statSync(path).size);
    printRuns(runs, result);
    printFile(file, runs.skipped);
    if (options.json) printJson(result);
  },
};

interface Runs {
  plain: LayoutResult;
  recorded: LayoutResult;
  /** Memory of the robot that records, each second, MB. */
  memoryMb: number[];
  /** Pictures that its encoders skipped, by camera. */
  skipped: number[];
}

/** Measures without a recording, then with one. @param path of the recording */
async function measureBoth(options: Options, folder: string, path: string): Promise<Runs> {
  const { size, fps, mbps, seconds, pictures: picturesPerSecond, videos } = options;
  const pictures = picturesPerSecond > 0;
  const robotArgs = [
    ...(pictures ? ['--pictures-of-cloud', '--pictures-per-second', String(picturesPerSecond)] : []),
    ...(videos > 0 ? videoArgs(folder, videos, options.encoder) : []),
  ];
  const run: ShmRun = { size, fps, mbps, seconds, pictures, videos, robotArgs };
  console.error('without a recording');
  const plain = await measure('farpoint', { ...run, seconds: Math.min(seconds, 20) });
  console.error(`with one, ${seconds} s`);
  const memoryMb: number[] = [];
  let encoded = NOTHING_ENCODED;
  const recorded = await measure('farpoint', {
    ...run,
    robotArgs: [...robotArgs, ...recordArgs(options, path)],
    onSecond: (pid) => memoryMb.push(residentMb(pid)),
    onEnd: async (adminUrl) => {
      if (videos > 0) encoded = await encodedVideos(adminUrl);
    },
  });
  return { plain, recorded, memoryMb, skipped: encoded.skipped };
}

function recordArgs({ compression }: Options, path: string): string[] {
  return [
    '--record',
    path,
    '--record-clouds',
    'both',
    '--record-max',
    'none',
    '--record-fps',
    '120',
    '--record-compression',
    compression,
  ];
}

type Figures = ReturnType<typeof figuresOf>;

/** @returns the object that `--json` prints */
function figuresOf(options: Options, runs: Runs, file: ReadBack, fileBytes: number) {
  const { plain, recorded, memoryMb } = runs;
  const { size, fps, seconds, mbps, compression, pictures: picturesPerSecond } = options;
  const fifth = Math.max(1, Math.floor(memoryMb.length / 5));
  return {
    bench: 'recording',
    points: size * size,
    fps,
    seconds,
    mbps,
    compression,
    picturesPerSecond,
    videoCameras: options.videos,
    latencyMs: recorded.latencyMs,
    latencyMsWithout: plain.latencyMs,
    addedMs: {
      p50: difference(recorded, plain, 'p50'),
      p95: difference(recorded, plain, 'p95'),
      p99: difference(recorded, plain, 'p99'),
    },
    framesPerSecond: recorded.framesPerSecond,
    framesPerSecondWithout: plain.framesPerSecond,
    ...(picturesPerSecond > 0 ? {} : { torn: recorded.torn }),
    videoSkipped: runs.skipped,
    rssMbMax: recorded.rssMbMax,
    rssMbBegin: mean(memoryMb.slice(0, fifth)),
    rssMbEnd: mean(memoryMb.slice(-fifth)),
    robotCpu: recorded.robotCpu,
    robotCpuWithout: plain.robotCpu,
    robotMainCpu: recorded.robotMainCpu,
    robotMainCpuWithout: plain.robotMainCpu,
    fileMbPerSecond: Math.round(fileBytes / 1e6 / (file.recordedSeconds || 1)),
    ...file,
  };
}

function printRuns({ plain, recorded }: Runs, result: Figures): void {
  printTable(
    ['latency, ms', 'p50', 'p95', 'p99', 'max'],
    [
      ['without', ...distributionCells(plain.latencyMs)],
      ['recorded', ...distributionCells(recorded.latencyMs)],
    ],
  );
  printTable(
    [
      'frames/s',
      'robot, cores',
      'without',
      'of it main',
      'without',
      'MB at begin',
      'MB at end',
      'MB most',
      'file, MB/s',
    ],
    [
      [
        result.framesPerSecond,
        result.robotCpu,
        result.robotCpuWithout,
        result.robotMainCpu,
        result.robotMainCpuWithout,
        result.rssMbBegin,
        result.rssMbEnd,
        result.rssMbMax,
        result.fileMbPerSecond,
      ],
    ],
  );
}

/** @param skipped pictures that the encoders skipped, by camera */
function printFile({ topics, videos }: ReadBack, skipped: readonly number[]): void {
  printTable(
    ['topic', 'recorded', 'dropped', 'MB'],
    Object.entries(topics).map(([name, { messages, dropped, mb }]) => [name, messages, dropped, mb]),
  );
  if (videos.length === 0) return;
  printTable(
    ['video', 'recorded', 'lost', 'kept, %', 'skipped by the encoder', 'frames/s', 'kB/s'],
    videos.map(({ name, frames, lost, keptShare, framesPerSecond, bytesPerSecond }, i) => [
      name,
      frames,
      lost,
      keptShare * 100,
      skipped[i],
      framesPerSecond,
      bytesPerSecond / 1000,
    ]),
  );
}

type ReadBack = Awaited<ReturnType<typeof readBack>>;

/** Reads every message. Missing messages show in the recorder's own counts. */
async function readBack(path: string) {
  const recording = await openRecording(path);
  const counts = new Map<string, number>();
  const bytes = new Map<string, number>();
  const videos = new Map<string, RecordedFrame[]>();
  let dropped: Record<string, number> = {};
  const begin = performance.now();
  for await (const { topic, logNs, data } of recording.messages(
    recording.topics.map(({ name }) => name),
    recording.startNs,
  )) {
    counts.set(topic.name, (counts.get(topic.name) ?? 0) + 1);
    bytes.set(topic.name, (bytes.get(topic.name) ?? 0) + data.length);
    if (topic.name.startsWith('/farpoint/videos/')) {
      const frames = videos.get(topic.name) ?? [];
      videos.set(topic.name, frames);
      frames.push({ ms: Number(logNs - recording.startNs) / 1e6, bytes: data.length });
    }
    if (topic.name !== '/farpoint/recorder') continue;
    const state = topic.decode(data) as { dropped: Record<string, number> };
    dropped = state.dropped;
  }
  const readSeconds = (performance.now() - begin) / 1000;
  const topics = Object.fromEntries(
    recording.topics.map(({ name, messages }) => {
      const read = counts.get(name) ?? 0;
      if (read !== messages) throw new Error(`${name}: ${read} of ${messages} messages can be read`);
      // The pictures of all cameras are counted together.
      const kind = name.split('/')[2] ?? '';
      const mb = Number(((bytes.get(name) ?? 0) / 1e6).toFixed(1));
      return [name, { messages: read, dropped: dropped[kind] ?? 0, mb }];
    }),
  );
  const seconds = Number(recording.endNs - recording.startNs) / 1e9;
  await recording.close();
  return {
    recordedSeconds: Number(seconds.toFixed(1)),
    topics,
    videos: [...videos].map(([name, frames]) => ({
      name: name.slice('/farpoint/videos/'.length),
      ...recordedVideo(frames, CAMERA.framesPerS),
    })),
    readSeconds: Number(readSeconds.toFixed(1)),
  };
}

function difference(a: LayoutResult, b: LayoutResult, key: 'p50' | 'p95' | 'p99'): number {
  return Number((a.latencyMs[key] - b.latencyMs[key]).toFixed(2));
}

function mean(values: readonly number[]): number {
  return Math.round(values.reduce((sum, value) => sum + value, 0) / values.length);
}

/** Current resident memory of a process, 10^6 bytes (Linux). */
function residentMb(pid: number): number {
  const line = /^VmRSS:\s+(\d+) kB$/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8'));
  return (Number(line?.[1] ?? Number.NaN) * 1024) / 1e6;
}
