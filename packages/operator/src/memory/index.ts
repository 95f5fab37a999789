/** The remembered world without a worker, for benchmarks and tests. */
export { FrameSamples } from './frame-samples.ts';
export { KEY_FRAME_BYTES, KEY_FRAME_SAMPLES, KeyFrame } from './key-frame.ts';
export { CHUNK_M, CHUNK_STEPS, PAGE_SURFELS, VOXEL_M } from './memory-layout.ts';
export { SurfelStore } from './surfel-store.ts';
export { MAX_RANGE_M, WorldMap } from './world-map.ts';
