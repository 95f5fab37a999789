export { type LoadedMeshes, loadMeshes, type MeshFile, type UnusedMesh } from './load-meshes.ts';
export { MeshFault, type MeshFaultCode } from './mesh-fault.ts';
export { readObj } from './obj.ts';
export { checkMeshFormat, MAX_MESH_FILE_BYTES } from './read-mesh.ts';
export { readStl } from './stl.ts';
