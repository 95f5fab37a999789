/** The thread that writes a recording, so that converting and writing megabytes per frame delays nothing else. */
import { type MessagePort, parentPort, workerData } from 'node:worker_threads';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { Recorder } from './recorder.ts';
import type {
  CloudDone,
  CloudRecord,
  RecorderOptions,
  RecorderReport,
  RecorderRequest,
} from './recorder-messages.ts';
import { RecordingWriter } from './recording-writer.ts';
import { SentCloudDecoder } from './sent-cloud.ts';

const FLUSH_MS = 500;
/** How long the capture thread may take to send its last clouds after all others have closed, ms. */
const LINGER_MS = 2000;

const port = parentPort;
if (port === null) throw new Error('recorder-worker.ts runs as a worker only');
const { clouds, ...options } = workerData as RecorderOptions & { clouds: MessagePort };
const send = (report: RecorderReport) => port.postMessage(report);
const writer = await RecordingWriter.create(options, new SentCloudDecoder(await loadCodecFromDisk()));
const recorder = new Recorder(writer, send);
const flushing = setInterval(() => void recorder.flush(), FLUSH_MS);

clouds.on('message', async (record: CloudRecord) => {
  await recorder.addCloud(record);
  const { buffer } = record;
  const kind = record.type === 'sent' ? 'sent' : 'captured';
  const done: CloudDone = { kind, buffer, ended: recorder.full };
  clouds.postMessage(done, [buffer]);
});
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
  send({ type: 'closed' });
  port.close();
});
send({ type: 'ready' });
