import { detailOf } from './errors.ts';
import { McapFileFull, type McapFileWriter } from './mcap-file-writer.ts';
import type { CloudRecord, RecorderReport, RecorderRequest } from './recorder-messages.ts';
import type { RecordingWriter } from './recording-writer.ts';

/** The file is synced to disk once in this many flushes, so that it also survives a crash of the machine. */
const SYNC_EVERY = 10;

/** The parts of {@link RecordingWriter} that a recorder uses. */
export type RecorderTarget = Pick<
  RecordingWriter,
  | 'addCameras'
  | 'addCloud'
  | 'addEvent'
  | 'addOwnState'
  | 'addPicture'
  | 'addVideo'
  | 'addVideos'
  | 'dropped'
  | 'faults'
> & { readonly file: Pick<McapFileWriter, 'bytes' | 'close' | 'flush' | 'messages' | 'sync'> };

/** A recording in progress: processes requests in order, until the file is full or cannot be written. */
export class Recorder {
  readonly #writer: RecorderTarget;
  readonly #send: (report: RecorderReport) => void;
  #failed = false;
  #full = false;
  #flushes = 0;
  #syncing = false;
  #tail: Promise<void> = Promise.resolve();

  constructor(writer: RecorderTarget, send: (report: RecorderReport) => void) {
    this.#writer = writer;
    this.#send = send;
  }

  /** Whether the file has reached its maximum size and is closed. */
  get full(): boolean {
    return this.#full;
  }

  /** Writes a cloud. Resolves once its memory can be reused, also after a failure. */
  addCloud(record: CloudRecord): Promise<void> {
    return this.#inTurn(() => this.#writer.addCloud(record));
  }

  /** Handles all requests except `close`. */
  onRequest(request: Exclude<RecorderRequest, { type: 'close' }>): void {
    if (request.type === 'cameras') {
      void this.#inTurn(async () => this.#writer.addCameras(request.cameras));
    } else if (request.type === 'videos') {
      void this.#inTurn(async () => this.#writer.addVideos(request.videos));
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
      await this.#writer.file.flush();
      this.#tell();
      this.#flushes++;
      if (this.#flushes % SYNC_EVERY === 0) this.#sync();
    });
  }

  /** Completes and closes the file. */
  async close(): Promise<void> {
    await this.#inTurn(async () => {
      await this.#addOwnState();
      await this.#writer.file.close();
    });
    this.#tell();
  }

  /** Syncs without anything waiting for it: a slow disk shows in the number of dropped records. */
  #sync(): void {
    if (this.#syncing) return;
    this.#syncing = true;
    void this.#writer.file
      .sync()
      .catch(() => {})
      .finally(() => {
        this.#syncing = false;
      });
  }

  #inTurn(work: () => Promise<void>): Promise<void> {
    this.#tail = this.#tail.then(async () => {
      if (this.#failed || this.#full) return;
      try {
        await work().catch((error: unknown) => this.#endIfFull(error));
      } catch (error) {
        this.#failed = true;
        this.#send({ type: 'failed', detail: detailOf(error) });
      }
    });
    return this.#tail;
  }

  async #endIfFull(error: unknown): Promise<void> {
    if (!(error instanceof McapFileFull)) throw error;
    this.#full = true;
    await this.#writer.file.close();
    this.#tell();
    this.#send({ type: 'full' });
  }

  async #addOwnState(): Promise<void> {
    if (this.#writer.file.messages > 0) await this.#writer.addOwnState();
  }

  #tell(): void {
    const { faults, dropped } = this.#writer;
    const { messages, bytes } = this.#writer.file;
    const { captured, sent } = dropped;
    this.#send({ type: 'written', messages, bytes, faults, dropped: { captured, sent } });
  }
}
