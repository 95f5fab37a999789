/**
 * The capture thread: source → sampler → packets. Rendering and encoding take milliseconds at a time; here they never
 * delay the thread that paces packets and reads commands.
 */

import { type MessagePort, parentPort, workerData } from 'node:worker_threads';
import { POINTS_PER_PACKET } from '@farpoint/protocol';
import { CloudTap } from '@farpoint/recording';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import type { BaseState } from '../base/base.ts';
import { monotonicMs, threadCpuMs } from '../clock.ts';
import { type CaptureBudget, NO_BUDGET } from '../encode/capture-budget.ts';
import type { CodedStream } from '../encode/coded-frame-encoder.ts';
import { type FormattedFrame, FrameFormats } from '../encode/frame-formats.ts';
import { SLOT_BYTES } from '../encode/packetiser.ts';
import { FramePlanner } from '../encode/plan.ts';
import type { TapReport } from '../pictures/picture-messages.ts';
import { PictureTap } from '../pictures/picture-tap.ts';
import { BufferPool } from './buffer-pool.ts';
import type { CaptureRecording } from './capture.ts';
import type { CaptureOptions, CaptureReport, CaptureRequest } from './capture-messages.ts';
import type { CameraDescription, CaptureWishes, ImageFrame, SourceFrame } from './frame-source.ts';
import { openSource } from './open-source.ts';
import { ReadyGate } from './ready-gate.ts';

/** One frame being sent, one waiting, one being filled; and one more, as some frames go out in two formats. */
const BUFFERS = 4;
const STATE_INTERVAL_MS = 20;
/** A state that stays as it is is repeated so often, as a sign of life, ms. */
const UNCHANGED_STATE_INTERVAL_MS = 100;
/** Longest time between two looks at a source that is asked for clouds, ms. */
const MAX_WAIT_MS = 10;
/** Of a source with a rhythm of its own: a cloud that waited longer for someone to watch is let go, ms. */
const MAX_READY_AGE_MS = 50;
const CLOUD_CAMERA: CameraDescription = { name: 'Camera', most: null, ofCloud: true };

const port = parentPort;
if (port === null) throw new Error('capture-worker.ts runs as a worker only');
const options = workerData as CaptureOptions & { recording: CaptureRecording | null };
const send = (report: CaptureReport, transfer: ArrayBuffer[] = []) => port.postMessage(report, transfer);

const source = await openSource(options.source);
const { description } = source;
const cameras = [
  ...(description.cameras ?? []),
  ...(options.picturesOfCloud === true && description.camera !== null ? [CLOUD_CAMERA] : []),
];
const { recording } = options;
const tap = recording === null ? null : new CloudTap(recording.clouds, recording.perSecond);
const codec = await loadCodecFromDisk();
const pool = new BufferPool(BUFFERS, Math.ceil(description.capacity / POINTS_PER_PACKET) * SLOT_BYTES);
const planner = new FramePlanner({
  policy: options.plan,
  mostFramesPerSecond: Math.min(
    options.framesPerSecond,
    description.framesPerSecond ?? options.framesPerSecond,
  ),
  anyRate: source.onReady === undefined,
  floorFraction: options.floorFraction,
  mostPoints: options.mostPoints,
});
const formats = new FrameFormats(
  codec,
  description,
  { ...options.sampling, sensor: options.sensor },
  planner,
  monotonicMs,
);
/** Weight of the latest frame in the mean of what a frame costs. */
const SMOOTHING = 0.1;

let budget: CaptureBudget = NO_BUDGET;
let frameNumber = 0;
/** The stream that the main thread knows. */
let stream: CodedStream | null = null;
/** The probe that the last enlarged frame was made for. */
let probeCluster = 0;
let workMs = 0;
let latencyTest = false;
/** Since when a source with a rhythm of its own has a cloud ready. */
let readySinceMs: number | null = null;
let pictures: PictureTap | null = null;
let picturePort: MessagePort | null = null;
let lastFault = '';
let nextFrameMs = monotonicMs();
const gate = new ReadyGate(monotonicMs(), 1000 / options.framesPerSecond);
let nextStateMs = 0;
let toldState: BaseState | null = null;
let toldStateMs = 0;
let closed = false;

port.on('message', (request: CaptureRequest) => {
  switch (request.type) {
    case 'budget':
      budget = request;
      // A cloud may have waited for somebody to watch.
      if (source.onReady !== undefined) takeReady();
      break;
    case 'latencyTest':
      latencyTest = true;
      break;
    case 'recycle':
      pool.release(request.buffer);
      break;
    case 'pictures':
      takePictures(request.port);
      break;
    case 'close':
      closed = true;
      source.close();
      picturePort?.close();
      tap?.close();
      send({ type: 'closed' });
      port.close();
      break;
  }
});

function tick(): void {
  if (closed) return;
  const now = monotonicMs();
  if (source.onReady === undefined && now >= nextFrameMs) {
    nextFrameMs += (budget.streaming ? captureFrame(now) : null) ?? 1000 / options.framesPerSecond;
    // After a stall the rhythm starts anew; frames are not made up for.
    if (nextFrameMs < monotonicMs()) nextFrameMs = monotonicMs();
  }
  if (now >= nextStateMs) {
    nextStateMs = now + STATE_INTERVAL_MS;
    tellState(now);
  }
  setTimeout(tick, waitMs());
}

/** Until the next tick: a source with a rhythm of its own calls by itself, and ticks are for the state alone. */
function waitMs(): number {
  const now = monotonicMs();
  if (source.onReady !== undefined) return Math.max(nextStateMs - now, 0);
  return Math.min(Math.max(nextFrameMs - now, 0), MAX_WAIT_MS);
}

function tellState(now: number): void {
  const { state } = source;
  if (state === toldState && now - toldStateMs < UNCHANGED_STATE_INTERVAL_MS) return;
  toldState = state;
  toldStateMs = now;
  send({ type: 'state', state: { ...state, timeMs: now }, framesWithoutBuffer: pool.refused });
}

/** The cloud that a source with a rhythm of its own has ready: now, or never. With nobody watching it stays where it is. */
function takeReady(): void {
  if (readySinceMs === null || closed || !budget.streaming) return;
  const now = monotonicMs();
  const aged = now - readySinceMs > MAX_READY_AGE_MS;
  readySinceMs = null;
  if (aged || pool.free === 0 || !gate.takes(now)) {
    source.skip?.(now, wishes());
    return;
  }
  const interval = captureFrame(now);
  if (interval !== null) gate.taken(now, interval);
}

function wishes(): CaptureWishes {
  return { bitsPerSecond: budget.targetBitsPerSecond, latencyTest };
}

/** @returns the time until the next one, ms; `null` where there was none */
function captureFrame(now: number): number | null {
  const buffer = pool.take();
  if (buffer === null) return null;
  pool.release(buffer);
  const cpuBefore = threadCpuMs();
  const frame = source.capture(now, wishes(), formats.room(budget.coded.length > 0));
  if (frame === null) return null;
  lastFault = '';
  const { captureMs: capturedAtMs } = frame;
  const captureMs = monotonicMs() - now;
  const captureCpuMs = threadCpuMs() - cpuBefore;
  const { probe } = budget;
  const probeBytes = probe === null || probe.clusterId === probeCluster ? 0 : probe.bytes;
  if (probe !== null) probeCluster = probe.clusterId;
  const green = latencyTest && frame.latencyTest !== false;
  const request = { frameNumber, budget, probeBytes, workMs, latencyTest: green };
  const { intervalMs, usefulBitsPerSecond, frames } = formats.encode(frame, request);
  frameNumber = (frameNumber + 1) >>> 0;
  if (formats.stream !== null && formats.stream !== stream) {
    stream = formats.stream;
    send({ type: 'stream', stream });
  }
  const { sensor } = options;
  const times = {
    sensor,
    usefulBitsPerSecond,
    intervalMs,
    capturedAtMs,
    captureMs,
    captureCpuMs,
    latencyTest: green,
  };
  for (const { encoded, audience, packets } of frames) {
    const buffer = pool.take();
    if (buffer === null) break;
    packets.copyPackets(new Uint8Array(buffer), encoded.packets);
    send({ type: 'frame', ...encoded, audience, buffer, ...times, readyMs: monotonicMs() }, [buffer]);
  }
  if (frame.form === 'images') offerPicture(frame);
  if (tap !== null) record(tap, frame, frames);
  if (green) latencyTest = false;
  workMs += (monotonicMs() - now - workMs) * (workMs === 0 ? 1 : SMOOTHING);
  return intervalMs;
}

/** The colour picture that a cloud came with, once its packets are on their way. */
function offerPicture({ colour, captureMs }: ImageFrame): void {
  const camera = cameras.indexOf(CLOUD_CAMERA);
  if (pictures === null || camera < 0 || !pictures.wants(camera, captureMs)) return;
  const { width, height } = description;
  const data = new Uint8Array(colour.buffer, colour.byteOffset, width * height * 4);
  const facts = { kind: 'raw', width, height, step: width * 4, encoding: 'rgba8', bigEndian: false } as const;
  pictures.offer({ camera, captureMs, facts, data });
}

function takePictures(from: MessagePort): void {
  const taker = new PictureTap(
    from,
    cameras.map(({ most }) => most),
  );
  pictures = taker;
  picturePort?.close();
  picturePort = from;
  from.on('message', (report: TapReport) => {
    taker.onReport(report);
    // One that was replaced says nothing any more.
    if (report.type === 'rates' && pictures === taker) source.watchPictures?.(report.perSecond);
  });
  source.usePictures?.(taker);
}

/** Once its packets are on their way: recording delays nothing but the next look at the source. */
function record(into: CloudTap, frame: SourceFrame, formatted: readonly FormattedFrame[]): void {
  into.captured(frame, description);
  for (const { encoded, packets } of formatted) {
    const { format, points, packets: count } = encoded;
    into.sent(frame, {
      ...{ format, points, packets: count, slotBytes: SLOT_BYTES },
      streamHeader: format === 'points64' ? null : (stream?.header ?? null),
      copyPackets: (buffer, n) => packets.copyPackets(buffer, n),
    });
  }
}

if (source.onReady !== undefined) {
  // One may have come before anybody listened.
  readySinceMs = monotonicMs();
  source.onReady = () => {
    readySinceMs = monotonicMs();
    takeReady();
  };
}
if (source.onFault !== undefined) {
  source.onFault = ({ message }) => {
    // While it is tried again and again it is said once.
    if (message !== lastFault) send({ type: 'fault', detail: message });
    lastFault = message;
  };
}
if (source.onReading !== undefined) source.onReading = (reading) => send({ type: 'reading', reading });
send({ type: 'ready', description, cameras });
source.start?.();
tick();
