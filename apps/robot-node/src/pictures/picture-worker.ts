/** The picture thread: pictures from the capture thread, made fit for the link, to the main thread. */
import { type MessagePort, parentPort, workerData } from 'node:worker_threads';
import { PictureCodec } from '@farpoint/pictures';
import {
  MAX_PICTURE_CHUNK_BYTES,
  nextSequence32,
  pictureChunks,
  stampUsOf,
  writePictureChunk,
} from '@farpoint/protocol';
import { threadCpuMs } from '../clock.ts';
import { PictureLossError, PictureMaker } from './picture-maker.ts';
import type {
  CameraPlan,
  OfferedPicture,
  PictureReport,
  PictureRequest,
  ReadyPicture,
  TapReport,
} from './picture-messages.ts';

const main = parentPort;
if (main === null) throw new Error('picture-worker.ts runs as a worker only');
const { tap } = workerData as { tap: MessagePort };
const codec = await PictureCodec.load();
const maker = new PictureMaker(codec);
const nextIds: number[] = [];
let plans: readonly CameraPlan[] = [];

main.on('message', (request: PictureRequest) => {
  plans = request.plans;
  tellTap({ type: 'rates', perSecond: plans.map(({ perSecond }) => perSecond) });
});

tap.on('message', (offered: OfferedPicture) => {
  const { camera, missed, data, origin } = offered;
  if (missed > 0) tellMain({ type: 'lost', camera, reason: 'busy', count: missed, detail: '' });
  const plan = plans[camera];
  if (plan !== undefined && plan.perSecond > 0) {
    try {
      const ready = makeReady(offered, plan);
      tellMain(ready, [(ready.chunks[0] as Uint8Array<ArrayBuffer>).buffer]);
    } catch (error) {
      if (!(error instanceof PictureLossError)) throw error;
      const from = origin === undefined ? {} : { origin };
      tellMain({ type: 'lost', camera, reason: error.reason, count: 1, detail: error.message, ...from });
    }
  }
  tellTap({ type: 'done', camera, room: data.buffer }, [data.buffer]);
  if (codec.trapped) throw new Error('the picture decoder gave up');
});

/** @throws {PictureLossError} */
function makeReady(offered: OfferedPicture, plan: CameraPlan): ReadyPicture {
  const { camera, capturedAtMs } = offered;
  const began = threadCpuMs();
  const { format, width, height, bytes, untouched } = maker.make(offered, plan);
  const pictureId = nextIds[camera] ?? 0;
  nextIds[camera] = nextSequence32(pictureId);
  const captureTimeUs = stampUsOf(capturedAtMs);
  const header = { format, camera, width, height, pictureId, captureTimeUs };
  const room = new Uint8Array(pictureChunks(bytes.length) * MAX_PICTURE_CHUNK_BYTES);
  const chunks: Uint8Array<ArrayBuffer>[] = [];
  for (let index = 0, at = 0; at < room.length; index++, at += MAX_PICTURE_CHUNK_BYTES) {
    const length = writePictureChunk(header, bytes, index, room.subarray(at, at + MAX_PICTURE_CHUNK_BYTES));
    chunks.push(room.subarray(at, at + length));
  }
  return {
    ...{ type: 'picture', header, capturedAtMs, fileBytes: bytes.length, chunks, untouched },
    ...{ longestSide: plan.longestSide, workMs: threadCpuMs() - began },
  };
}

function tellMain(report: PictureReport, transfer: ArrayBuffer[] = []): void {
  main?.postMessage(report, transfer);
}

function tellTap(report: TapReport, transfer: ArrayBuffer[] = []): void {
  tap.postMessage(report, transfer);
}
