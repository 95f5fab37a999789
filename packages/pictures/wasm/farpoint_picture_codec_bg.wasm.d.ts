/* tslint:disable */
/* eslint-disable */
export const memory: WebAssembly.Memory;
export const __wbg_pixels_free: (a: number, b: number) => void;
export const decode_jpeg: (a: number, b: number, c: number) => [number, number, number];
export const decode_png: (a: number, b: number, c: number) => [number, number, number];
export const encode_jpeg: (a: number, b: number, c: number, d: number, e: number) => [number, number, number, number];
export const pixels_height: (a: number) => number;
export const pixels_take: (a: number) => [number, number];
export const pixels_width: (a: number) => number;
export const __wbindgen_externrefs: WebAssembly.Table;
export const __wbindgen_malloc: (a: number, b: number) => number;
export const __wbindgen_free: (a: number, b: number, c: number) => void;
export const __externref_table_dealloc: (a: number) => void;
export const __wbindgen_start: () => void;
