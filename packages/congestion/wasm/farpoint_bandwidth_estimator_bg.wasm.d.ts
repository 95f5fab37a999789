/* tslint:disable */
/* eslint-disable */
export const memory: WebAssembly.Memory;
export const __wbg_bandwidthestimator_free: (a: number, b: number) => void;
export const bandwidthestimator_feedback: (a: number, b: number, c: number, d: number) => void;
export const bandwidthestimator_loss: (a: number) => number;
export const bandwidthestimator_new: (a: number, b: number, c: number, d: number) => number;
export const bandwidthestimator_pacing: (a: number) => number;
export const bandwidthestimator_rowsCapacity: (a: number) => number;
export const bandwidthestimator_rowsPointer: (a: number) => number;
export const bandwidthestimator_rttUs: (a: number) => number;
export const bandwidthestimator_sent: (a: number, b: number) => void;
export const bandwidthestimator_takeProbe: (a: number) => [number, number];
export const bandwidthestimator_target: (a: number) => number;
export const bandwidthestimator_tick: (a: number, b: number) => void;
export const bandwidthestimator_window: (a: number) => number;
export const __wbindgen_externrefs: WebAssembly.Table;
export const __wbindgen_free: (a: number, b: number, c: number) => void;
export const __wbindgen_start: () => void;
