/** The thread that writes a recording: converting and writing megabytes per frame must not delay anything else. */
import { type MessagePort, parentPort, workerData } from 'node:worker_threads';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { detailOf } from './errors.ts';
import { McapFileFull } from './mcap-file-writer.ts';
import type {
  CloudDone,
  CloudRecord,
  RecorderOptions,
  RecorderReport,
  RecorderRequest,
} from './recorder-messages.ts';
import { RecordingWriter } from './recording-writer.ts';
import { SentCloudDecoder } from './sent-cloud.ts';

/**
 * After this long, ms, recorded data survives the end of the process; the recording writes its own state at the same
 * interval.
 */
const FLUSH_MS = 500;
/** How long the capture thread has to deliver its last clouds after the other threads have finished, ms. */
const LINGER_MS = 2000;
/** … and a crash of the machine, after this many intervals. */
const SYNC_EVERY = 10;

const port = parentPort;
if (port === null) throw new Error('recorder-worker.ts runs as a worker only');
const { clouds, ...options } = workerData as RecorderOptions & { clouds: MessagePort };
const send = (report: RecorderReport) => port.postMessage(report);

const writer = await RecordingWriter.create(options, new SentCloudDecoder(await loadCodecFromDisk()));
let failed = false;
/** The file has reached its maximum size and is closed. */
let full = false;
let flushes = 0;
let syncing = false;
/** Runs one task after the other. */
let tail: Promise<void> = Promise.resolve();

function tell(): void {
  const { faults, dropped } = writer;
  const { messages, bytes } = writer.file;
  const { captured, sent } = dropped;
  send({ type: 'written', messages, bytes, faults, dropped: { captured, sent } });
}

async function addOwnState(): Promise<void> {
  if (writer.file.messages > 0) await writer.addOwnState();
}

function inTurn(work: () => Promise<void>): Promise<void> {
  tail = tail.then(async () => {
    if (failed || full) return;
    try {
      await work().catch(endIfFull);
    } catch (error) {
      failed = true;
      send({ type: 'failed', detail: detailOf(error) });
    }
  });
  return tail;
}

async function endIfFull(error: unknown): Promise<void> {
  if (!(error instanceof McapFileFull)) throw error;
  full = true;
  await writer.file.close();
  tell();
  send({ type: 'full' });
}

clouds.on('message', (record: CloudRecord) => {
  const { buffer } = record;
  const kind = record.type === 'sent' ? 'sent' : 'captured';
  // The memory goes back once the chunk that refers to it is written, also after a failure.
  void inTurn(() => writer.addCloud(record)).then(() => {
    const done: CloudDone = { kind, buffer, ended: full };
    clouds.postMessage(done, [buffer]);
  });
});

/** The capture thread has sent everything. */
const cloudsEnd = new Promise<void>((resolve) => clouds.once('close', resolve));

const flushing = setInterval(() => {
  void inTurn(async () => {
    await addOwnState();
    await writer.file.flush();
    tell();
    if (++flushes % SYNC_EVERY !== 0 || syncing) return;
    syncing = true;
    // Nothing waits for this: a slow disk shows in what is dropped.
    void writer.file
      .sync()
      .catch(() => {})
      .finally(() => {
        syncing = false;
      });
  });
}, FLUSH_MS);

port.on('message', (request: RecorderRequest) => {
  if (request.type === 'cameras') {
    void inTurn(async () => writer.addCameras(request.cameras));
    return;
  }
  if (request.type === 'picture') {
    void inTurn(() => writer.addPicture(request)).then(() => send({ type: 'done', kind: 'pictures' }));
    return;
  }
  if (request.type !== 'close') {
    void inTurn(() => writer.addEvent(request)).then(() => send({ type: 'done', kind: 'events' }));
    return;
  }
  clearInterval(flushing);
  setTimeout(() => clouds.close(), LINGER_MS).unref();
  void cloudsEnd
    .then(() =>
      inTurn(async () => {
        await addOwnState();
        await writer.file.close();
      }),
    )
    .then(() => {
      tell();
      send({ type: 'closed' });
      clouds.close();
      port.close();
    });
});
send({ type: 'ready' });
