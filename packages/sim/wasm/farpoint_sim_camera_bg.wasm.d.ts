/* tslint:disable */
/* eslint-disable */
export const memory: WebAssembly.Memory;
export const __wbg_depthcamera_free: (a: number, b: number) => void;
export const depthcamera_colourPointer: (a: number) => number;
export const depthcamera_depthPointer: (a: number) => number;
export const depthcamera_new: (a: number, b: number, c: number, d: number) => [number, number, number];
export const depthcamera_pointsPointer: (a: number) => number;
export const depthcamera_posesLength: (a: number) => number;
export const depthcamera_posesPointer: (a: number) => number;
export const depthcamera_render: (a: number, b: number, c: number, d: number) => void;
export const __wbindgen_externrefs: WebAssembly.Table;
export const __wbindgen_malloc: (a: number, b: number) => number;
export const __wbindgen_free: (a: number, b: number, c: number) => void;
export const __externref_table_dealloc: (a: number) => void;
export const __wbindgen_start: () => void;
