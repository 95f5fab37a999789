import type { Twist } from '@farpoint/protocol';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile } from '../mapped-file.ts';
import { BUSY_BYTES, CONTROL_BYTES, ECHO_OFFSET, referenceFiles } from './layout.ts';

export interface ControlBlock {
  counter: number;
  twist: Twist;
}

/** Reads `shared_control`, like the program that moves the wheels. */
export class ReferenceControlReader implements Disposable {
  readonly #block: MappedFile;
  readonly #busy: MappedFile;
  readonly #bytes = new Uint8Array(CONTROL_BYTES);

  /**
   * @param options.answers whether {@link answer} will be called, which needs a file that this process may write
   * @throws {SharedMemoryError}
   */
  constructor(folder?: string, options: { answers?: boolean } = {}) {
    const paths = referenceFiles(folder);
    this.#block = MappedFile.open(paths.control, { bytes: CONTROL_BYTES });
    try {
      this.#busy = MappedFile.open(paths.busy, { bytes: BUSY_BYTES, writable: options.answers === true });
    } catch (error) {
      this.#block.close();
      throw error;
    }
  }

  get current(): boolean {
    return this.#block.current && this.#busy.current;
  }

  /**
   * The block, or `null` while it is being written: call again.
   *
   * @throws {SharedMemoryError} `bad-frame` for velocities that are not finite; `truncated`
   */
  read(): ControlBlock | null {
    if (this.#busy.load8(0) !== 0) return null;
    this.#block.copyOut(0, this.#bytes);
    this.#block.fence();
    const view = new DataView(this.#bytes.buffer);
    // A complete write may have happened meanwhile, which changes the counter.
    if (this.#busy.load8(0) !== 0 || this.#block.load32(0) !== view.getUint32(0, true)) return null;
    const value = (index: number): number => {
      const offset = 4 + index * 8;
      const number = view.getFloat64(offset, true);
      if (!Number.isFinite(number))
        throw new SharedMemoryError('bad-frame', this.#block.path, offset, `a velocity of ${number}`);
      return number;
    };
    return {
      counter: view.getInt32(0, true),
      twist: {
        linear: { x: value(0), y: value(1), z: value(2) },
        angular: { x: value(3), y: value(4), z: value(5) },
      },
    };
  }

  /**
   * Tells the robot that the wheels have been given the velocity with this counter. A robot that was answered once stops
   * when the answers end.
   *
   * @throws {SharedMemoryError} `truncated`
   */
  answer(counter: number): void {
    this.#busy.store8(ECHO_OFFSET, counter & 0xff);
  }

  close(): void {
    this.#block.close();
    this.#busy.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }
}
