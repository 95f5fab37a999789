/**
 * The capture thread: source → sampler → packets. Rendering and encoding take milliseconds at a time. In this thread
 * they never delay the thread that paces packets and reads commands.
 */
import { parentPort, workerData } from 'node:worker_threads';
import { CloudTap } from '@farpoint/recording';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { monotonicMs, threadCpuMs } from '../../ground/clock.ts';
import { SensorGuard } from '../obstacles/sensor-guard.ts';
import { openSource } from '../sources/open-source.ts';
import type { CaptureRecording } from './capture.ts';
import { CaptureLoop } from './capture-loop.ts';
import type { CaptureOptions, CaptureRequest, ReportSink } from './capture-messages.ts';
import { CapturePictures } from './capture-pictures.ts';
import { CapturePipeline } from './pipeline.ts';

const port = parentPort;
if (port === null) throw new Error('capture-worker.ts runs as a worker only');
const { recording, ...options } = workerData as CaptureOptions & { recording: CaptureRecording | null };
const send: ReportSink = (report, transfer = []) => port.postMessage(report, transfer);

const source = await openSource(options.source);
const codec = await loadCodecFromDisk();
const pictures = new CapturePictures(source, options.picturesOfCloud === true);
const tap =
  recording === null ? null : new CloudTap(recording.clouds, recording.perSecond, recording.livePerSecond);
const clocks = { now: monotonicMs, threadCpu: threadCpuMs };
const guard =
  options.guard === undefined
    ? null
    : await SensorGuard.open(codec, options.source, source.description, options.guard);
const frames = new CapturePipeline(source, codec, options, clocks, send, { pictures, recording: tap, guard });
const loop = new CaptureLoop(source, frames, {
  framesPerSecond: options.framesPerSecond,
  sourceFramesPerSecond: source.description.framesPerSecond,
  now: monotonicMs,
  send,
});

function keepCapturing(): void {
  if (!loop.closed) setTimeout(keepCapturing, loop.captureDue());
}

port.on('message', (request: CaptureRequest) => {
  if (request.type === 'pictures') pictures.use(request.port);
  else loop.onRequest(request);
  if (loop.closed) port.close();
});
send({ type: 'ready', description: source.description, cameras: pictures.cameras });
source.start?.();
keepCapturing();
