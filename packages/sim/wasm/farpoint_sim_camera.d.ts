/* tslint:disable */
/* eslint-disable */

/**
 * The camera as JavaScript sees it. Buffers stay where they are for its lifetime; the pointers are offsets
 * into the module's memory.
 */
export class DepthCamera {
    free(): void;
    [Symbol.dispose](): void;
    /**
     * Four bytes a pixel: R, G, B, 255.
     */
    colourPointer(): number;
    /**
     * A float a pixel: metres, 0 where invalid.
     */
    depthPointer(): number;
    /**
     * See `Scene::read` and `Config::read` for what the numbers mean.
     */
    constructor(scene: Float32Array | number[], config: Float64Array | number[]);
    /**
     * Four words a pixel: x, y, z as floats and the colour's bytes. To be read after each `render` with points: they are
     * made at the first.
     */
    pointsPointer(): number;
    /**
     * Their number: 12 × (1 + bodies).
     */
    posesLength(): number;
    /**
     * 12 × (1 + bodies) doubles, to be written before `render`: rotation matrices row by row, translations.
     */
    posesPointer(): number;
    /**
     * Draws one frame; the same number gives the same noise. Without faults it is the ground truth.
     */
    render(frame_number: number, without_faults: boolean, with_points: boolean): void;
}

export type InitInput = RequestInfo | URL | Response | BufferSource | WebAssembly.Module;

export interface InitOutput {
    readonly memory: WebAssembly.Memory;
    readonly __wbg_depthcamera_free: (a: number, b: number) => void;
    readonly depthcamera_colourPointer: (a: number) => number;
    readonly depthcamera_depthPointer: (a: number) => number;
    readonly depthcamera_new: (a: number, b: number, c: number, d: number) => [number, number, number];
    readonly depthcamera_pointsPointer: (a: number) => number;
    readonly depthcamera_posesLength: (a: number) => number;
    readonly depthcamera_posesPointer: (a: number) => number;
    readonly depthcamera_render: (a: number, b: number, c: number, d: number) => void;
    readonly __wbindgen_externrefs: WebAssembly.Table;
    readonly __wbindgen_malloc: (a: number, b: number) => number;
    readonly __wbindgen_free: (a: number, b: number, c: number) => void;
    readonly __externref_table_dealloc: (a: number) => void;
    readonly __wbindgen_start: () => void;
}

export type SyncInitInput = BufferSource | WebAssembly.Module;

/**
 * Instantiates the given `module`, which can either be bytes or
 * a precompiled `WebAssembly.Module`.
 *
 * @param {{ module: SyncInitInput }} module - Passing `SyncInitInput` directly is deprecated.
 *
 * @returns {InitOutput}
 */
export function initSync(module: { module: SyncInitInput } | SyncInitInput): InitOutput;

/**
 * If `module_or_path` is {RequestInfo} or {URL}, makes a request and
 * for everything else, calls `WebAssembly.instantiate` directly.
 *
 * @param {{ module_or_path: InitInput | Promise<InitInput> }} module_or_path - Passing `InitInput` directly is deprecated.
 *
 * @returns {Promise<InitOutput>}
 */
export default function __wbg_init (module_or_path: { module_or_path: InitInput | Promise<InitInput> } | InitInput | Promise<InitInput>): Promise<InitOutput>;
