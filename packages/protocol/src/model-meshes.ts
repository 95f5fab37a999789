/**
 * The meshes of the robot's model: `modelMeshes` on the `session` channel, after the model itself. The robot has read them
 * from its own files and reduced them; what is sent are triangles, and no name, address or file.
 */
import * as z from 'zod/mini';
import { uint32Schema } from './identifiers.ts';

/** All meshes of a model together, as they are sent. */
export const MAX_MODEL_MESH_BYTES = 262_144;
/** Of the meshes in one message: it is one packet. */
export const MAX_MESH_PART_BYTES = 720;

/** Some bytes of the meshes of the robot's model. */
export interface ModelMeshParts {
  /** Tells the message from others. */
  type: 'modelMeshes';
  /** The model to which they belong. */
  model: number;
  /** How many bytes the meshes have. */
  count: number;
  /** How many of them were told before. */
  at: number;
  /** The next of them, base64. */
  data: string;
}

export const modelMeshesSchema = z
  .strictObject({
    type: z.literal('modelMeshes'),
    model: uint32Schema,
    count: z.int().check(z.minimum(1), z.maximum(MAX_MODEL_MESH_BYTES)),
    at: z.int().check(z.minimum(0)),
    data: z.base64().check(z.minLength(4), z.maxLength((MAX_MESH_PART_BYTES / 3) * 4)),
  })
  .check(
    z.refine(({ count, at, data }) => at + lengthOf(data) <= count, {
      path: ['data'],
      error: 'must be bytes of the meshes',
    }),
  ) satisfies z.ZodMiniType<ModelMeshParts>;

/** @param data of a message that was checked */
export function bytesOfBase64(data: string): Uint8Array {
  const text = atob(data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function lengthOf(base64: string): number {
  return (base64.length / 4) * 3 - (base64.endsWith('==') ? 2 : base64.endsWith('=') ? 1 : 0);
}
