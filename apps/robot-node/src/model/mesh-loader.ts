import { Worker } from 'node:worker_threads';
import { allMeshesLeft, type LinkMeshes, type MeshesLeft } from '@farpoint/ros';
import type { Logger } from '@farpoint/service';
import type { MeshOrder, MeshReport } from './mesh-messages.ts';

/** A model whose meshes take longer has none, ms. */
const MOST_MS = 60_000;
/** Of the thread, without the files themselves. */
const MOST_HEAP_MB = 512;

/** Meshes as they are sent to operators, and what of the model is not drawn. */
export interface ModelMeshBytes {
  /** `null`: there is nothing to send. */
  bytes: Uint8Array | null;
  left: MeshesLeft;
}

/**
 * Reads the meshes of the robot's model, in a thread of its own at the time of each model: that takes seconds, in which nothing
 * else may wait.
 */
export class MeshLoader {
  readonly #folders: readonly string[];
  readonly #log: Logger;
  #worker: Worker | null = null;

  constructor(folders: readonly string[], log: Logger) {
    this.#folders = folders;
    this.#log = log;
  }

  /** Forgets what it was reading before. @param done is told once, unless another model comes first */
  load(links: readonly LinkMeshes[], done: (meshes: ModelMeshBytes) => void): void {
    void this.#worker?.terminate();
    this.#worker = null;
    if (!links.some(({ meshes }) => meshes.length > 0)) return;
    if (this.#folders.length === 0) {
      this.#log.info('the model has meshes, and none is read: no --mesh-dir is given');
      done({ bytes: null, left: allMeshesLeft(links, 'the robot has no folder for meshes') });
      return;
    }
    this.#read(links, done);
  }

  #read(links: readonly LinkMeshes[], done: (meshes: ModelMeshBytes) => void): void {
    const order: MeshOrder = { links, folders: this.#folders };
    const worker = new Worker(new URL('./mesh-worker.ts', import.meta.url), {
      ...{ name: 'meshes', workerData: order, resourceLimits: { maxOldGenerationSizeMb: MOST_HEAP_MB } },
    });
    this.#worker = worker;
    // Meshes must keep nobody from ending.
    worker.unref();
    const late = setTimeout(() => void worker.terminate(), MOST_MS).unref();
    let report: MeshReport | null = null;
    worker.on('message', (told: MeshReport) => {
      report = told;
    });
    worker.on('error', (error) => this.#log.error({ err: error }, 'the mesh thread failed'));
    worker.once('exit', () => {
      clearTimeout(late);
      if (this.#worker !== worker) return;
      this.#worker = null;
      if (report === null) done({ bytes: null, left: allMeshesLeft(links, 'they could not be read') });
      else done(this.#logged(report));
    });
  }

  #logged({ bytes, left, unused, triangles }: MeshReport): ModelMeshBytes {
    for (const each of unused) this.#log.warn(each, 'a mesh of the model is not drawn');
    if (bytes !== null) this.#log.info({ triangles, bytes: bytes.length }, 'meshes of the model read');
    return { bytes, left };
  }
}
