/* tslint:disable */
/* eslint-disable */

/**
 * A picture's pixels.
 */
export class Pixels {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * R, G, B, A of each; it is given away.
     */
    take(): Uint8Array;
    /**
     * Rows.
     */
    readonly height: number;
    /**
     * Pixels of a row.
     */
    readonly width: number;
}

/**
 * # Errors
 * Where it is no JPEG, broken, or has more than `most_pixels`.
 */
export function decode_jpeg(bytes: Uint8Array | number[], most_pixels: number): Pixels;

/**
 * # Errors
 * Where it is no PNG, broken, or has more than `most_pixels`.
 */
export function decode_png(bytes: Uint8Array | number[], most_pixels: number): Pixels;

/**
 * A baseline JPEG with half the colour resolution. Alpha is passed over.
 *
 * # Errors
 * Where `rgba` is not `width × height × 4` bytes, or a side is 0.
 */
export function encode_jpeg(rgba: Uint8Array | number[], width: number, height: number, quality: number): Uint8Array;

export type InitInput = RequestInfo | URL | Response | BufferSource | WebAssembly.Module;

export interface InitOutput {
    readonly memory: WebAssembly.Memory;
    readonly __wbg_pixels_free: (a: number, b: number) => void;
    readonly decode_jpeg: (a: number, b: number, c: number) => [number, number, number];
    readonly decode_png: (a: number, b: number, c: number) => [number, number, number];
    readonly encode_jpeg: (a: number, b: number, c: number, d: number, e: number) => [number, number, number, number];
    readonly pixels_height: (a: number) => number;
    readonly pixels_take: (a: number) => [number, number];
    readonly pixels_width: (a: number) => number;
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
