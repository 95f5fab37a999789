/** The main thread's end of pictures. Owns the picture thread, tells it what to make, and distributes the results. */
import { MessageChannel, Worker } from 'node:worker_threads';
import type { Logger } from '@farpoint/service';
import { ReasonCounts } from '../../ground/robot-counters.ts';
import type { Capture } from '../../sense/capture/capture.ts';
import type {
  CameraPlan,
  PictureReport,
  PictureRequest,
  ReadyPicture,
} from '../../sense/pictures/picture-messages.ts';
import { PicturePlanner, type PicturePolicy } from '../../sense/pictures/picture-plan.ts';

/** An operator who may watch pictures. */
export interface PictureTarget {
  /** The operator's id, as known to the guard. */
  readonly id: string;
  readonly streaming: boolean;
  readonly watchedCameras: ReadonlySet<number>;
  /** The share of the operator's path for pictures, bit/s on the wire. */
  readonly pictureBitsPerSecond: number;
  offerPicture(picture: ReadyPicture): void;
}

export interface PictureHubOptions {
  policy: PicturePolicy;
  capture: Pick<Capture, 'cameras' | 'usePictures'>;
  targets: () => Iterable<PictureTarget>;
  /** The operator whose path decides the size of pictures; `null` if nobody drives. */
  driver: () => string | null;
  /** Called with each picture, for whichever operators it is. */
  onMade: (picture: ReadyPicture) => void;
  log: Logger;
}

/**
 * A thread that ended is started again after this time, ms. Chosen: pictures are not what is driven by, so
 * there is no hurry.
 */
const RESTART_MS = 1000;
/** Shortest time between two plans, ms: rates change with the feedback, many times a second. */
const PLAN_MS = 250;

export interface PictureCounters {
  made: number;
  /** Processor time of the picture thread, s. */
  workSeconds: number;
  lost: ReasonCounts;
  /** Number of restarts of the picture thread. */
  restarts: number;
}

export class PictureHub {
  readonly counters: PictureCounters = {
    made: 0,
    workSeconds: 0,
    restarts: 0,
    lost: new ReasonCounts(),
  };
  readonly #options: PictureHubOptions;
  readonly #planners: PicturePlanner[];
  readonly #lastDetail: string[] = [];
  #worker: Worker | null = null;
  #restart: NodeJS.Timeout | null = null;
  #told = '';
  #plannedMs = Number.NEGATIVE_INFINITY;
  #closed = false;

  constructor(options: PictureHubOptions) {
    this.#options = options;
    this.#planners = options.capture.cameras.map(() => new PicturePlanner(options.policy));
    this.#start();
  }

  /** Updates the plans, at most a few times a second. */
  update(nowMs: number): void {
    if (nowMs - this.#plannedMs < PLAN_MS) return;
    this.#plannedMs = nowMs;
    const watching = [...this.#options.targets()].filter(
      ({ streaming, watchedCameras }) => streaming && watchedCameras.size > 0,
    );
    const driver = watching.find(({ id }) => id === this.#options.driver());
    // Each picture is encoded once for everyone. The driver's path decides; without a driver, the narrowest path
    // does.
    const deciding = driver === undefined ? watching : [driver];
    const narrowest = Math.min(...deciding.map(({ pictureBitsPerSecond }) => pictureBitsPerSecond));
    const shown = this.#planners.map((_, camera) =>
      watching.some(({ watchedCameras }) => watchedCameras.has(camera)),
    );
    const share = watching.length === 0 ? 0 : narrowest / shown.filter(Boolean).length;
    this.#tell(this.#planners.map((planner, camera) => planner.plan(shown[camera] ? share : 0)));
  }

  async close(): Promise<void> {
    this.#closed = true;
    if (this.#restart !== null) clearTimeout(this.#restart);
    await this.#worker?.terminate();
  }

  #start(): void {
    const { port1, port2 } = new MessageChannel();
    const worker = new Worker(new URL('../../sense/pictures/picture-worker.ts', import.meta.url), {
      name: 'pictures',
      workerData: { tap: port1 },
      transferList: [port1],
    });
    this.#options.capture.usePictures(port2);
    this.#told = '';
    this.#worker = worker;
    worker.on('message', (report: PictureReport) => this.#onReport(report));
    worker.on('error', (error) => this.#options.log.error({ err: error }, 'the picture thread failed'));
    worker.on('exit', () => {
      if (this.#closed) return;
      // A failure with pictures must not stop the robot.
      this.counters.restarts++;
      this.#worker = null;
      this.#restart = setTimeout(() => this.#start(), RESTART_MS);
    });
  }

  #tell(plans: readonly CameraPlan[]): void {
    const text = JSON.stringify(plans);
    if (text === this.#told || this.#worker === null) return;
    this.#told = text;
    const request: PictureRequest = { type: 'plans', plans };
    this.#worker.postMessage(request);
  }

  #onReport(report: PictureReport): void {
    const { counters } = this;
    if (report.type === 'lost') {
      const { camera, reason, count, detail, origin } = report;
      counters.lost.add(reason, count);
      if (detail === '' || this.#lastDetail[camera] === detail) return;
      // A fault that persists is reported once.
      this.#lastDetail[camera] = detail;
      const { name } = this.#options.capture.cameras[camera] ?? { name: String(camera) };
      this.#options.log.warn({ camera: name, reason, detail, origin }, 'a picture cannot be shown');
      return;
    }
    const { header, fileBytes, longestSide, workMs } = report;
    counters.made++;
    counters.workSeconds += workMs / 1000;
    this.#planners[header.camera]?.onMade(fileBytes, longestSide);
    for (const target of this.#options.targets()) target.offerPicture(report);
    this.#options.onMade(report);
  }
}
