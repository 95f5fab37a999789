/** The picture thread: turns the capture thread's pictures into files that fit the link, and sends them to the main thread. */
import { type MessagePort, parentPort, workerData } from 'node:worker_threads';
import { PictureCodec } from '@farpoint/pictures';
import { threadCpuMs } from '../../ground/clock.ts';
import { PictureMaker } from './picture-maker.ts';
import type { OfferedPicture, PictureRequest } from './picture-messages.ts';
import { PictureProcessor } from './picture-processor.ts';

const main = parentPort;
if (main === null) throw new Error('picture-worker.ts runs as a worker only');
const { tap } = workerData as { tap: MessagePort };
const codec = await PictureCodec.load();
const processor = new PictureProcessor({
  maker: new PictureMaker(codec),
  threadCpu: threadCpuMs,
  tellMain: (report, transfer = []) => main.postMessage(report, transfer),
  tellTap: (report, transfer = []) => tap.postMessage(report, transfer),
});

main.on('message', (request: PictureRequest) => processor.onRequest(request));
tap.on('message', (offered: OfferedPicture) => {
  processor.onOffered(offered);
  // Its memory may be damaged: a new thread takes over.
  if (codec.trapped) throw new Error('the picture decoder gave up');
});
