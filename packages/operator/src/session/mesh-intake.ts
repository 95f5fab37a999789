import { bytesOfBase64, decodeModelMeshes, type ModelMeshes, type ModelMeshParts } from '@farpoint/protocol';

/** Puts the meshes of the robot's model together as they come. */
export class MeshIntake {
  #coming: { model: number; bytes: Uint8Array; length: number } | null = null;

  /** Bytes that do not follow those before end them. */
  forget(): void {
    this.#coming = null;
  }

  /** @returns the meshes, once all are known @throws {ProtocolError} if they are no meshes */
  take({ model, count, at, data }: ModelMeshParts): ModelMeshes | null {
    // Within its bound, by the schema.
    if (at === 0) this.#coming = { model, bytes: new Uint8Array(count), length: 0 };
    const coming = this.#coming;
    if (coming === null) return null;
    if (coming.model !== model || coming.bytes.length !== count || coming.length !== at) {
      this.#coming = null;
      return null;
    }
    const part = bytesOfBase64(data);
    coming.bytes.set(part, at);
    coming.length += part.length;
    if (coming.length < count) return null;
    this.#coming = null;
    return decodeModelMeshes(coming.bytes);
  }
}
