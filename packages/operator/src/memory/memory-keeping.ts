/** The memory worker's work, without the worker: takes key frames, hands changed pages on. The clock is an argument. */
import { KeyFrame } from './key-frame.ts';
import { TICKS_PER_S, ticksOf } from './memory-layout.ts';
import type { FromMemoryWorker, ToMemoryWorker } from './memory-messages.ts';
import { MemoryPages, PAGES_BYTES } from './memory-pages.ts';
import { isPcd, readPcd, writePcd } from './pcd.ts';
import { readPly, writePly } from './ply.ts';
import { PointFileError } from './point-file.ts';
import { TopView } from './top-view.ts';
import { WorldMap, type WorldMapOptions } from './world-map.ts';

/** Buffers for pages. While all are on their way, changes wait. */
const BUFFERS = 4;

export interface MemoryPort {
  post(message: FromMemoryWorker, transfer: Transferable[]): void;
  /** `performance.now()` */
  nowMs(): number;
}

export class MemoryKeeping {
  readonly map: WorldMap;
  readonly #port: MemoryPort;
  readonly #buffers = Array.from({ length: BUFFERS }, () => new ArrayBuffer(PAGES_BYTES));

  constructor(port: MemoryPort, options: WorldMapOptions = {}) {
    this.#port = port;
    this.map = new WorldMap(options);
  }

  onMessage(message: ToMemoryWorker): void {
    const { map } = this;
    switch (message.type) {
      case 'frame':
        this.#take(new KeyFrame(message.buffer));
        return;
      case 'return':
        this.#buffers.push(message.buffer);
        break;
      case 'forget':
        map.clear();
        this.#port.post({ type: 'forgotten', jumped: false }, []);
        return;
      case 'limits':
        map.jump.limits = message.limits;
        return;
      case 'resend':
        for (let page = 0; page < map.store.pages; page++) {
          if ((map.store.pageChunks[page] as number) >= 0) map.store.noteChange(page);
        }
        break;
      case 'topView':
        this.#lookFromAbove(message);
        return;
      case 'save':
        this.#save(message);
        return;
      case 'load':
        this.#load(message);
    }
    this.#handOn();
  }

  #take(frame: KeyFrame): void {
    const { map } = this;
    const beganMs = this.#port.nowMs();
    const { jumped } = map.take(frame);
    if (jumped) this.#port.post({ type: 'forgotten', jumped: true }, []);
    this.#handOn();
    const busyMs = this.#port.nowMs() - beganMs;
    const { count: surfels, bytes } = map.store;
    const { buffer } = frame;
    this.#port.post({ type: 'taken', buffer, stats: { surfels, bytes, busyMs } }, [buffer]);
  }

  #handOn(): void {
    while (this.map.store.changedPages > 0) {
      const buffer = this.#buffers.pop();
      if (buffer === undefined) return;
      const pages = new MemoryPages(buffer);
      pages.fill(this.map.store);
      this.#port.post({ type: 'pages', buffer, count: pages.count }, [buffer]);
    }
  }

  #lookFromAbove({ buffer, area, nowMs }: ToMemoryWorker & { type: 'topView' }): void {
    const view = new TopView(buffer);
    view.fill(this.map.store, area, ticksOf(nowMs));
    const { x, y, oldestS } = view;
    this.#port.post({ type: 'topView', buffer, x, y, oldestS }, [buffer]);
  }

  #save({ ticket, nowMs, savedAt, format }: ToMemoryWorker & { type: 'save' }): void {
    const { store } = this.map;
    const now = ticksOf(nowMs);
    const bytes =
      format === 'ply'
        ? writePly(store, now, savedAt)
        : writePcd(store, format === 'pcd' ? 'binary' : 'ascii', now, savedAt);
    this.#port.post({ type: 'saved', ticket, bytes }, [bytes]);
  }

  #load({ ticket, nowMs, agoS, bytes }: ToMemoryWorker & { type: 'load' }): void {
    try {
      const whole = new Uint8Array(bytes);
      const file = isPcd(whole) ? readPcd(whole) : readPly(whole);
      const now = ticksOf(nowMs);
      let points = 0;
      for (let i = 0; i < file.count; i++) {
        const [x, y, z] = [file.places[i * 3], file.places[i * 3 + 1], file.places[i * 3 + 2]];
        const ticks = Math.max(now - Math.round(((file.agesS[i] as number) + agoS) * TICKS_PER_S), 0);
        const isNew = this.map.restore(
          x as number,
          y as number,
          z as number,
          file.colours[i] as number,
          ticks,
        );
        points += Number(isNew);
      }
      this.#port.post({ type: 'loaded', ticket, points }, []);
    } catch (error) {
      if (!(error instanceof PointFileError)) throw error;
      this.#port.post({ type: 'refused', ticket, message: error.message }, []);
    }
  }
}
