/** The memory worker's work, without the worker: takes key frames, hands changed pages on. The clock is an argument. */
import { KeyFrame } from './key-frame.ts';
import type { readIntoMemory, writeMemory } from './memory-files.ts';
import { ticksOf } from './memory-layout.ts';
import type { FromMemoryWorker, ToMemoryWorker } from './memory-messages.ts';
import { MemoryPages, PAGES_BYTES } from './memory-pages.ts';
import { PointFileError } from './point-file.ts';
import { TopView } from './top-view.ts';
import { WorldMap, type WorldMapOptions } from './world-map.ts';

/** Buffers for pages. While all are on their way, changes wait. */
const BUFFERS = 4;

export interface MemoryPort {
  post(message: FromMemoryWorker, transfer: Transferable[]): void;
  /** `performance.now()` */
  nowMs(): number;
  /** Hands over what reads and writes files, which is loaded with the first of them; or says that it cannot be loaded. */
  withFiles(use: (files: MemoryFiles) => void, failed: () => void): void;
}

export interface MemoryFiles {
  readonly writeMemory: typeof writeMemory;
  readonly readIntoMemory: typeof readIntoMemory;
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
        return;
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
    this.#withFiles(ticket, ({ writeMemory: write }) => {
      const bytes = write(this.map.store, format, ticksOf(nowMs), savedAt);
      this.#port.post({ type: 'saved', ticket, bytes }, [bytes]);
    });
  }

  #load({ ticket, nowMs, agoS, bytes }: ToMemoryWorker & { type: 'load' }): void {
    this.#withFiles(ticket, ({ readIntoMemory: read }) => {
      try {
        const points = read(this.map, bytes, ticksOf(nowMs), agoS);
        this.#port.post({ type: 'loaded', ticket, points }, []);
      } catch (error) {
        if (!(error instanceof PointFileError)) throw error;
        this.#port.post({ type: 'refused', ticket, message: error.message }, []);
      }
      this.#handOn();
    });
  }

  #withFiles(ticket: number, use: (files: MemoryFiles) => void): void {
    const message = 'the code for files could not be loaded: check the network';
    this.#port.withFiles(use, () => this.#port.post({ type: 'refused', ticket, message }, []));
  }
}
