import type { Twist } from '@farpoint/protocol';
import { type Addon, type ControlHandle, loadAddon } from '../addon.ts';
import { MappedFile, type TrustedOwner, translated } from '../mapped-file.ts';
import { BUSY_BYTES, CONTROL_BYTES, ECHO_OFFSET, referenceFiles } from './layout.ts';

export interface ControlWriterOptions {
  folder?: string | undefined;
  /** Permissions of created files. Default 0600. */
  mode?: number | undefined;
  /** Whose files are used besides this user's own. */
  owner?: TrustedOwner | undefined;
  /** After this long without a write, a native thread writes zero velocity, ms. */
  silenceMs: number;
}

const IN_USE = 'end that program, or give this one a folder of its own (--shm-folder)';

/**
 * Writes the velocity into `shared_control`, with a counter that grows by one each time. The reader sets the velocity
 * to zero when the counter stops.
 *
 * It holds the file's lock for as long as it lives: of two writers, the stop of one would not stop the other.
 */
export class ReferenceControlWriter implements Disposable {
  readonly #options: ControlWriterOptions;
  readonly #addon: Addon = loadAddon();
  readonly #values = new Float64Array(6);
  #files: { block: MappedFile; busy: MappedFile; control: ControlHandle } | null;
  #silencesBefore = 0;

  /** @throws {SharedMemoryError} a {@link FileInUseError} while another writer lives */
  constructor(options: ControlWriterOptions) {
    this.#options = options;
    this.#files = this.#open();
  }

  /**
   * Writes a velocity. Files that the reader has removed or recreated are opened again.
   *
   * @returns the counter
   * @throws {SharedMemoryError} if it could not be written; the next write tries again
   */
  write({ linear, angular }: Twist): number {
    if (this.#files !== null && !(this.#files.block.current && this.#files.busy.current)) this.#close();
    this.#files ??= this.#open();
    this.#values.set([linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]);
    try {
      return this.#addon.controlWrite(this.#files.control, this.#values);
    } catch (error) {
      throw translated(error, this.#files.block.path, CONTROL_BYTES);
    }
  }

  /**
   * The lowest byte of the counter that the reader has acted on, if it is a reader that answers; 0 before the first.
   *
   * @throws {SharedMemoryError} `truncated`
   */
  readerEcho(): number {
    return this.#files?.busy.load8(ECHO_OFFSET) ?? 0;
  }

  /** How often silence has set the velocity to zero. */
  get silences(): number {
    return (
      this.#silencesBefore + (this.#files === null ? 0 : this.#addon.controlSilences(this.#files.control))
    );
  }

  /** Writes zero velocity and closes the files. */
  close(): void {
    this.#close();
  }

  [Symbol.dispose](): void {
    this.close();
  }

  #open(): { block: MappedFile; busy: MappedFile; control: ControlHandle } {
    const { folder, mode, owner, silenceMs } = this.#options;
    const paths = referenceFiles(folder);
    const create = { create: true, owner, ...(mode === undefined ? {} : { mode }) };
    const block = MappedFile.open(paths.control, { bytes: CONTROL_BYTES, ...create });
    let busy: MappedFile | null = null;
    try {
      // Before a thread of ours could write anything.
      block.claim(IN_USE);
      busy = MappedFile.open(paths.busy, { bytes: BUSY_BYTES, ...create });
      return { block, busy, control: this.#addon.control(block.handle, busy.handle, silenceMs) };
    } catch (error) {
      block.close();
      busy?.close();
      throw error;
    }
  }

  #close(): void {
    if (this.#files === null) return;
    this.#silencesBefore = this.silences;
    const { block, busy, control } = this.#files;
    this.#files = null;
    this.#addon.controlClose(control);
    block.close();
    busy.close();
  }
}
