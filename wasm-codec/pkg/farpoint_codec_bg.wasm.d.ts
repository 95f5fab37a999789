/* tslint:disable */
/* eslint-disable */
export const memory: WebAssembly.Memory;
export const __wbg_decoder_free: (a: number, b: number) => void;
export const __wbg_encoder_free: (a: number, b: number) => void;
export const decoder_counts_ptr: (a: number) => number;
export const decoder_create: (a: number, b: number, c: number) => number;
export const decoder_points_ptr: (a: number) => number;
export const decoder_slots_ptr: (a: number) => number;
export const decoder_unpack: (a: number, b: number) => number;
export const encoder_chosen_ptr: (a: number) => number;
export const encoder_create: (a: number, b: number, c: number) => number;
export const encoder_frame_ptr: (a: number) => number;
export const encoder_pack: (a: number, b: number, c: number) => void;
export const encoder_report_ptr: (a: number) => number;
export const encoder_sample: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number, i: bigint) => number;
export const encoder_slots_ptr: (a: number) => number;
export const __wbindgen_externrefs: WebAssembly.Table;
export const __wbindgen_start: () => void;
