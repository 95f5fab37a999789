import type { PictureTaker, SourcePicture } from '@farpoint/cloud-source';
import { RateLimit } from '@farpoint/ros';
import type { OfferedPicture, TapReport } from './picture-messages.ts';

/** The port of the picture thread, which gets the offered pictures. */
export interface TapPort {
  postMessage(picture: OfferedPicture, transfer: ArrayBuffer[]): void;
}

interface Camera {
  limit: RateLimit | null;
  /** Whether the picture thread is working on a picture of this camera. */
  busy: boolean;
  missed: number;
  /** Memory of the last picture, reused for the next one. */
  room: ArrayBuffer | null;
}

/**
 * The capture thread's end of pictures. The picture thread gets one picture per camera at a time. When it is done, it
 * gets the next one to arrive. So no picture waits and ages, and unwanted pictures cost nothing.
 */
export class PictureTap implements PictureTaker {
  readonly #port: TapPort;
  readonly #cameras: Camera[];
  readonly #most: readonly (number | null)[];

  /** @param most pictures per second that each camera's topic allows; `null`: no limit */
  constructor(port: TapPort, most: readonly (number | null)[]) {
    this.#port = port;
    this.#most = most;
    this.#cameras = most.map(() => ({ limit: null, busy: false, missed: 0, room: null }));
  }

  wants(camera: number, nowMs: number): boolean {
    const of = this.#cameras[camera];
    if (of === undefined || of.limit === null || !of.limit.admits(nowMs)) return false;
    if (of.busy) of.missed++;
    return !of.busy;
  }

  offer({ data, ...picture }: SourcePicture): void {
    const { camera } = picture;
    const of = this.#cameras[camera];
    if (of === undefined || of.busy) return;
    const room =
      of.room !== null && of.room.byteLength >= data.length ? of.room : new ArrayBuffer(data.length);
    const copy = new Uint8Array(room, 0, data.length);
    copy.set(data);
    this.#port.postMessage({ ...picture, data: copy, missed: of.missed }, [room]);
    Object.assign(of, { busy: true, missed: 0, room: null });
  }

  onReport(report: TapReport): void {
    if (report.type === 'done') {
      const of = this.#cameras[report.camera];
      if (of !== undefined) Object.assign(of, { busy: false, room: report.room });
      return;
    }
    for (const [camera, of] of this.#cameras.entries()) {
      const perSecond = Math.min(
        report.perSecond[camera] ?? 0,
        this.#most[camera] ?? Number.POSITIVE_INFINITY,
      );
      if (perSecond === 0) of.limit = null;
      else if (of.limit === null) of.limit = new RateLimit(perSecond);
      else of.limit.change(perSecond);
    }
  }
}
