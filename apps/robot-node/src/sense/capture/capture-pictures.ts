import type { MessagePort } from 'node:worker_threads';
import type { CameraDescription, FrameSource, ImageFrame } from '@farpoint/cloud-source';
import type { TapReport } from '../pictures/picture-messages.ts';
import { PictureTap } from '../pictures/picture-tap.ts';

const CLOUD_CAMERA: CameraDescription = { name: 'Camera', most: null, ofCloud: true };

/** A capture thread's pictures: those of its source's cameras, and the colour pictures that clouds are made from. */
export class CapturePictures {
  readonly cameras: readonly CameraDescription[];
  readonly #source: FrameSource;
  #tap: PictureTap | null = null;
  #port: MessagePort | null = null;

  /** @param ofCloud also offer the colour pictures of the camera that the clouds come from, if they come from one */
  constructor(source: FrameSource, ofCloud: boolean) {
    const { cameras = [], camera } = source.description;
    this.cameras = ofCloud && camera !== null ? [...cameras, CLOUD_CAMERA] : cameras;
    this.#source = source;
  }

  /** Sends pictures to this port from now on, and closes the previous one. */
  use(port: MessagePort): void {
    const tap = new PictureTap(
      port,
      this.cameras.map(({ most }) => most),
    );
    this.#tap = tap;
    this.#port?.close();
    this.#port = port;
    port.on('message', (report: TapReport) => {
      tap.onReport(report);
      // Messages from a replaced port may still be in flight.
      if (report.type === 'rates' && this.#tap === tap) this.#source.watchPictures?.(report.perSecond);
    });
    this.#source.usePictures?.(tap);
  }

  /** Offers the colour picture of a cloud that was just captured. */
  offer({ colour, capturedAtMs }: ImageFrame): void {
    const camera = this.cameras.indexOf(CLOUD_CAMERA);
    if (this.#tap === null || camera < 0 || !this.#tap.wants(camera, capturedAtMs)) return;
    const { width, height } = this.#source.description;
    const data = new Uint8Array(colour.buffer, colour.byteOffset, width * height * 4);
    const facts = {
      kind: 'raw',
      width,
      height,
      step: width * 4,
      encoding: 'rgba8',
      bigEndian: false,
    } as const;
    this.#tap.offer({ camera, capturedAtMs, facts, data });
  }

  close(): void {
    this.#port?.close();
  }
}
