import {
  MAX_PICTURE_CHUNK_BYTES,
  nextSequence32,
  pictureChunks,
  stampUsOf,
  writePictureChunk,
} from '@farpoint/protocol';
import { type MadePicture, PictureLossError, type PictureMaker } from './picture-maker.ts';
import type {
  CameraPlan,
  OfferedPicture,
  PictureReport,
  PictureRequest,
  ReadyPicture,
  TapReport,
} from './picture-messages.ts';

export interface PictureProcessorOptions {
  maker: Pick<PictureMaker, 'make'>;
  /** Processor time of this thread, ms. */
  threadCpu: () => number;
  /** Sends to the main thread; buffers in `transfer` are transferred. */
  tellMain: (report: PictureReport, transfer?: ArrayBuffer[]) => void;
  /** Sends to the capture thread; buffers in `transfer` are transferred. */
  tellTap: (report: TapReport, transfer?: ArrayBuffer[]) => void;
}

/** Prepares the pictures that the capture thread offers, one at a time, by the main thread's plans. */
export class PictureProcessor {
  readonly #options: PictureProcessorOptions;
  readonly #nextIds: number[] = [];
  #plans: readonly CameraPlan[] = [];

  constructor(options: PictureProcessorOptions) {
    this.#options = options;
  }

  onRequest({ plans }: PictureRequest): void {
    this.#plans = plans;
    this.#options.tellTap({ type: 'rates', perSecond: plans.map(({ perSecond }) => perSecond) });
  }

  /** Reports each offered picture as `picture` or `lost`, or ignores it if unwatched. Its memory always goes back. */
  onOffered(offered: OfferedPicture): void {
    const { tellMain, tellTap } = this.#options;
    const { camera, missed, data, origin } = offered;
    if (missed > 0) tellMain({ type: 'lost', camera, reason: 'busy', count: missed, detail: '' });
    const plan = this.#plans[camera];
    if (plan !== undefined && plan.perSecond > 0) {
      try {
        const ready = this.#prepare(offered, plan);
        tellMain(ready, [(ready.chunks[0] as Uint8Array<ArrayBuffer>).buffer]);
      } catch (error) {
        if (!(error instanceof PictureLossError)) throw error;
        const from = origin === undefined ? {} : { origin };
        tellMain({ type: 'lost', camera, reason: error.reason, count: 1, detail: error.message, ...from });
      }
    }
    tellTap({ type: 'done', camera, room: data.buffer }, [data.buffer]);
  }

  /** @throws {PictureLossError} */
  #prepare(offered: OfferedPicture, plan: CameraPlan): ReadyPicture {
    const { maker, threadCpu } = this.#options;
    const { camera, capturedAtMs } = offered;
    const began = threadCpu();
    const made = maker.make(offered, plan);
    const pictureId = this.#nextIds[camera] ?? 0;
    this.#nextIds[camera] = nextSequence32(pictureId);
    const { format, width, height, untouched } = made;
    const captureTimeUs = stampUsOf(capturedAtMs);
    const header = { format, camera, width, height, pictureId, captureTimeUs };
    return {
      type: 'picture',
      header,
      capturedAtMs,
      untouched,
      fileBytes: made.bytes.length,
      chunks: chunksOf(header, made),
      longestSide: plan.longestSide,
      workMs: threadCpu() - began,
    };
  }
}

/** The messages that carry a picture, all in one buffer. */
function chunksOf(header: ReadyPicture['header'], { bytes }: MadePicture): Uint8Array<ArrayBuffer>[] {
  const room = new Uint8Array(pictureChunks(bytes.length) * MAX_PICTURE_CHUNK_BYTES);
  const chunks: Uint8Array<ArrayBuffer>[] = [];
  for (let index = 0, at = 0; at < room.length; index++, at += MAX_PICTURE_CHUNK_BYTES) {
    const length = writePictureChunk(header, bytes, index, room.subarray(at, at + MAX_PICTURE_CHUNK_BYTES));
    chunks.push(room.subarray(at, at + length));
  }
  return chunks;
}
