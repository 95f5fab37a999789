/**
 * The thread that writes a recording and serves live viewers: converting and writing megabytes per frame must not delay
 * anything else.
 */
import { type MessagePort, parentPort, workerData } from 'node:worker_threads';
import { LiveListener, LiveServer } from '@farpoint/foxglove';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { detailOf } from './errors.ts';
import { Recorder } from './recorder.ts';
import {
  type CloudAnswer,
  type CloudRecord,
  NO_LIVE_WISHES,
  type RecorderOptions,
  type RecorderReport,
  type RecorderRequest,
} from './recorder-messages.ts';
import { RecordingWriter } from './recording-writer.ts';
import { SentCloudDecoder } from './sent-cloud.ts';

/** How often what is written goes to the file, ms. Chosen: a crash costs half a second of a recording. */
const FLUSH_MS = 500;
/** How long the capture thread has for its last clouds after all others have closed, ms. */
const LINGER_MS = 2000;

const port = parentPort;
if (port === null) throw new Error('recorder-worker.ts runs as a worker only');
const { clouds, ...options } = workerData as RecorderOptions & { clouds: MessagePort };
const FILE_CHANGES: ReadonlySet<RecorderReport['type']> = new Set([
  'fileOpened',
  'fileClosed',
  'full',
  'failed',
]);
const send = (report: RecorderReport) => {
  port.postMessage(report);
  // The capture thread copies clouds only while somebody takes them.
  if (FILE_CHANGES.has(report.type)) answer(null);
};

const name = { name: options.robotId, sessionId: String(options.epochNs) };
let wishes = NO_LIVE_WISHES;
const live =
  options.live === undefined
    ? null
    : new LiveServer(name, {
        onInterest: () => {
          wishes = writer.liveWishes;
          send({ type: 'wishes', wishes });
          answer(null);
        },
        onKeyNeeded: (channel) => {
          const video = writer.videoOfLive(channel);
          if (video >= 0) send({ type: 'keyFrame', video });
        },
      });
const writer = await RecordingWriter.create(options, live, new SentCloudDecoder(await loadCodecFromDisk()));
const recorder = new Recorder(writer, send);
const flushing = setInterval(() => {
  void recorder.flush();
  if (live !== null && listener !== null)
    send({ type: 'live', ...live.counts, connectionsRefused: { ...listener.refused } });
}, FLUSH_MS);

function answer(done: CloudAnswer['done']): void {
  const message: CloudAnswer = { wishes: { file: recorder.fileOpen, live: wishes.clouds }, done };
  clouds.postMessage(message, done === null ? [] : [done.buffer]);
}

clouds.on('message', async (record: CloudRecord) => {
  await recorder.addCloud(record);
  answer({ kind: record.type === 'sent' ? 'sent' : 'captured', buffer: record.buffer });
});
answer(null);
const cloudsEnd = new Promise<void>((resolve) => clouds.once('close', resolve));

port.on('message', async (request: RecorderRequest) => {
  if (request.type !== 'close') {
    recorder.onRequest(request);
    return;
  }
  clearInterval(flushing);
  setTimeout(() => clouds.close(), LINGER_MS).unref();
  await cloudsEnd;
  await recorder.close();
  await listener?.close();
  send({ type: 'closed' });
  port.close();
});

let listener: LiveListener | null = null;
let failed = '';
if (live !== null && options.live !== undefined) {
  try {
    listener = await LiveListener.open(options.live, live);
  } catch (error) {
    // A robot drives without viewers.
    failed = detailOf(error);
  }
}
send({
  type: 'ready',
  live: live === null ? null : listener === null ? { failed } : { port: listener.port },
});
