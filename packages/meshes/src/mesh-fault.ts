/** Why a mesh of the robot's model cannot be drawn. */
export const meshFaultCodes = [
  'bad-address', // it names no file that could be looked for
  'not-permitted', // it is outside the folders from which meshes are read
  'not-found', // no such file, or it cannot be read
  'unsupported', // a format that is not read
  'too-large', // more bytes, triangles or metres than are read
  'too-many', // more meshes than are drawn, or more triangles than it can be reduced to
  'bad-mesh', // not what its format says
  'empty', // it has no triangle that could be seen
] as const;
export type MeshFaultCode = (typeof meshFaultCodes)[number];

/** A mesh cannot be drawn; the message says why, for people. */
export class MeshFault extends Error {
  override readonly name = 'MeshFault';
  readonly code: MeshFaultCode;

  constructor(code: MeshFaultCode, detail: string) {
    super(detail);
    this.code = code;
  }
}
