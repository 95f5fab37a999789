import { RateLimit } from '@farpoint/ros';
import type { OfferedPicture, TapReport } from './picture-messages.ts';
import type { PictureTaker, SourcePicture } from './source-picture.ts';

/** Where offered pictures go: the port of the picture thread. */
export interface TapPort {
  postMessage(picture: OfferedPicture, transfer: ArrayBuffer[]): void;
}

interface Camera {
  limit: RateLimit | null;
  /** One of its pictures is with the picture thread. */
  busy: boolean;
  missed: number;
  /** Memory of the last picture, for the next one. */
  room: ArrayBuffer | null;
}

/**
 * The capture thread's end: of each camera one picture at a time is with the picture thread, and the next that comes after
 * it is done is the next. So none waits and grows old, and what is not wanted costs nothing.
 */
export class PictureTap implements PictureTaker {
  readonly #port: TapPort;
  readonly #cameras: Camera[];
  readonly #most: readonly (number | null)[];

  /** @param most pictures a second that each camera's own topic allows */
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
