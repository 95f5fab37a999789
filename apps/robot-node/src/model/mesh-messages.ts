/** What the main thread and the mesh thread tell each other. */
import type { LoadedMeshes, MeshFaultCode } from '@farpoint/meshes';
import type { LinkMeshes } from '@farpoint/ros';

export interface MeshOrder {
  links: readonly LinkMeshes[];
  /** In which they are looked for. */
  folders: readonly string[];
}

export interface MeshReport extends Omit<LoadedMeshes, 'unused'> {
  unused: { address: string; code: MeshFaultCode; detail: string }[];
}
