/** The meshes of the robot's model, and what of them each operator is told next: slowly, and only while the path takes it. */
import { MAX_MESH_PART_BYTES, type ModelMeshParts } from '@farpoint/protocol';
import type { PathWidth } from './navigation-board.ts';

/** Time between two messages, ms: 115 and 14 kbit/s of meshes. */
const PARTS_MS = { wide: 50, narrow: 400 };
/** While more waits to be sent, nothing is added: a path that stalls must not be filled with meshes. */
const MOST_WAITING_BYTES = 4096;

interface Told {
  bytes: Uint8Array;
  at: number;
  partsMs: number;
}

export class MeshBoard {
  #bytes: Uint8Array | null = null;
  readonly #told = new WeakMap<object, Told>();

  /** @param bytes `null`: there are none */
  take(bytes: Uint8Array | null): void {
    this.#bytes = bytes;
  }

  /**
   * The next bytes for an operator who knows the model: `null` if it has all, or if it is too early.
   *
   * @param model to which they belong
   * @param waiting bytes that wait for the operator's path
   */
  next(
    operator: object,
    model: number,
    width: PathWidth,
    waiting: number,
    nowMs: number,
  ): ModelMeshParts | null {
    const bytes = this.#bytes;
    if (bytes === null || waiting > MOST_WAITING_BYTES) return null;
    const known = this.#told.get(operator);
    const told = known?.bytes === bytes ? known : { bytes, at: 0, partsMs: Number.NEGATIVE_INFINITY };
    this.#told.set(operator, told);
    const { at } = told;
    if (at >= bytes.length || nowMs - told.partsMs < PARTS_MS[width]) return null;
    const part = bytes.subarray(at, at + MAX_MESH_PART_BYTES);
    Object.assign(told, { at: at + part.length, partsMs: nowMs });
    const data = Buffer.from(part.buffer, part.byteOffset, part.length).toString('base64');
    return { type: 'modelMeshes', model, count: bytes.length, at, data };
  }
}
