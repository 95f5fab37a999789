import { detailOf } from './errors.ts';
import { McapFileFull } from './mcap-file-writer.ts';
import type { MessageOutputs } from './message-outputs.ts';
import type { CloudRecord, RecorderReport, RecorderRequest } from './recorder-messages.ts';
import type { RecordingWriter } from './recording-writer.ts';

/** The file is synced to disk once in this many flushes, so that it also survives a crash of the machine. */
const SYNC_EVERY = 10;

/** The parts of {@link RecordingWriter} that a recorder uses. */
export type RecorderTarget = Pick<
  RecordingWriter,
  | 'addCameras'
  | 'addCloud'
  | 'addComponents'
  | 'addEvent'
  | 'addOwnState'
  | 'addPicture'
  | 'addTelemetry'
  | 'addVideo'
  | 'addVideos'
  | 'dropped'
  | 'faults'
  | 'openFile'
> & {
  readonly out: Pick<
    MessageOutputs,
    'abandonFile' | 'bytes' | 'closeFile' | 'fileOpen' | 'flush' | 'messages' | 'open' | 'sync'
  >;
};

/**
 * A recording in progress: processes requests in order. When the file is full or cannot be written, it ends; live
 * viewers go on, and another file may be begun.
 */
export class Recorder {
  readonly #writer: RecorderTarget;
  readonly #send: (report: RecorderReport) => void;
  #flushes = 0;
  #syncing = false;
  #tail: Promise<void> = Promise.resolve();

  constructor(writer: RecorderTarget, send: (report: RecorderReport) => void) {
    this.#writer = writer;
    this.#send = send;
  }

  /** Whether clouds are still written to the file. */
  get fileOpen(): boolean {
    return this.#writer.out.fileOpen;
  }

  /** Writes a cloud. Resolves once its memory can be reused, also after a failure. */
  addCloud(record: CloudRecord): Promise<void> {
    return this.#inTurn(() => this.#writer.addCloud(record));
  }

  /** Handles all requests except `close`. */
  onRequest(request: Exclude<RecorderRequest, { type: 'close' }>): void {
    if (request.type === 'openFile') {
      void this.#openFile(request.path);
    } else if (request.type === 'closeFile') {
      void this.#closeFile().then(() => this.#send({ type: 'fileClosed' }));
    } else if (request.type === 'cameras') {
      this.#describe(() => this.#writer.addCameras(request.cameras));
    } else if (request.type === 'videos') {
      this.#describe(() => this.#writer.addVideos(request.videos));
    } else if (request.type === 'telemetry') {
      this.#describe(() => this.#writer.addTelemetry(request.quantities, request.alarms));
    } else if (request.type === 'components') {
      this.#describe(() => this.#writer.addComponents(request.topic));
    } else if (request.type === 'video') {
      const added = this.#inTurn(() => this.#writer.addVideo(request));
      void added.then(() => this.#send({ type: 'done', kind: 'videos' }));
    } else if (request.type === 'picture') {
      const added = this.#inTurn(() => this.#writer.addPicture(request));
      void added.then(() => this.#send({ type: 'done', kind: 'pictures' }));
    } else {
      const added = this.#inTurn(() => this.#writer.addEvent(request));
      void added.then(() => this.#send({ type: 'done', kind: 'events' }));
    }
  }

  /** Call it every half second: everything recorded until then survives the end of the process. */
  flush(): Promise<void> {
    return this.#inTurn(async () => {
      await this.#addOwnState();
      await this.#writer.out.flush();
      this.#tell();
      this.#flushes++;
      if (this.#flushes % SYNC_EVERY === 0) this.#sync();
    });
  }

  /** Completes and closes the file. */
  async close(): Promise<void> {
    await this.#closeFile();
  }

  async #closeFile(): Promise<void> {
    await this.#inTurn(async () => {
      await this.#addOwnState();
      await this.#writer.out.closeFile();
    });
    this.#tell();
  }

  #openFile(path: string): Promise<void> {
    this.#tail = this.#tail.then(async () => {
      let failed: string | null = null;
      try {
        if (this.#writer.out.fileOpen) failed = 'another file is being written';
        else await this.#writer.openFile(path);
      } catch (error) {
        this.#writer.out.abandonFile();
        failed = detailOf(error);
      }
      this.#send({ type: 'fileOpened', path, failed });
    });
    return this.#tail;
  }

  /** Syncs without anything waiting for it: a slow disk shows in the number of dropped records. */
  #sync(): void {
    if (this.#syncing) return;
    this.#syncing = true;
    void this.#writer.out
      .sync()
      .catch(() => {})
      .finally(() => {
        this.#syncing = false;
      });
  }

  /** In its turn, too, but also where nothing takes messages yet: a file may be begun later. */
  #describe(work: () => void): void {
    void this.#inTurn(async () => work(), true);
  }

  /** @param always also where nothing takes messages */
  #inTurn(work: () => Promise<void>, always = false): Promise<void> {
    this.#tail = this.#tail.then(async () => {
      if (!always && !this.#writer.out.open) return;
      try {
        await work().catch((error: unknown) => this.#endIfFull(error));
      } catch (error) {
        this.#writer.out.abandonFile();
        this.#send({ type: 'failed', detail: detailOf(error) });
      }
    });
    return this.#tail;
  }

  async #endIfFull(error: unknown): Promise<void> {
    if (!(error instanceof McapFileFull)) throw error;
    await this.#writer.out.closeFile();
    this.#tell();
    this.#send({ type: 'full' });
  }

  async #addOwnState(): Promise<void> {
    if (this.#writer.out.messages > 0) await this.#writer.addOwnState();
  }

  #tell(): void {
    const { faults, dropped } = this.#writer;
    const { messages, bytes } = this.#writer.out;
    const { captured, sent } = dropped;
    this.#send({ type: 'written', messages, bytes, faults, dropped: { captured, sent } });
  }
}
