/** The mesh thread: reads the meshes of one model, tells the main thread, and ends. */
import { parentPort, workerData } from 'node:worker_threads';
import { loadMeshes } from '@farpoint/meshes';
import { MeshFolders } from './mesh-folders.ts';
import type { MeshOrder, MeshReport } from './mesh-messages.ts';

const main = parentPort;
if (main === null) throw new Error('mesh-worker.ts runs as a worker only');
const { links, folders } = workerData as MeshOrder;
const from = new MeshFolders(folders);
const { unused, ...loaded } = await loadMeshes(links, (address) => from.read(address));
const report: MeshReport = {
  ...loaded,
  unused: unused.map(({ address, fault }) => ({ address, code: fault.code, detail: fault.message })),
};
main.postMessage(report);
