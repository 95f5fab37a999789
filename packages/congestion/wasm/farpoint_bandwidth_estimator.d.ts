/* tslint:disable */
/* eslint-disable */

/**
 * One path's controller.
 */
export class BandwidthEstimator {
    free(): void;
    [Symbol.dispose](): void;
    /**
     * The first `count` rows are one feedback message (see `RESULT_ROW`).
     */
    feedback(count: number, in_flight: number, now_us: number): void;
    /**
     * Begins at `start_bps`, between the other two.
     */
    constructor(start_bps: number, min_bps: number, max_bps: number, now_us: number);
    /**
     * How many rows fit.
     */
    rowsCapacity(): number;
    /**
     * Where the rows are written before `sent` and `feedback`; an offset into the module's memory.
     */
    rowsPointer(): number;
    /**
     * The first `count` rows are packets that left (see `SENT_ROW`), in order.
     */
    sent(count: number): void;
    /**
     * Takes the next wish for a probe: cluster (from 1), bit/s, bytes. Empty where there is none.
     */
    takeProbe(): Float64Array;
    /**
     * To be called every 25 ms or more often.
     */
    tick(now_us: number): void;
    /**
     * Of the packets sent, 0–1.
     */
    readonly loss: number;
    /**
     * How fast packets may leave.
     */
    readonly pacing: number;
    /**
     * Round trip; NaN before the first.
     */
    readonly rttUs: number;
    /**
     * What media may use.
     */
    readonly target: number;
    /**
     * Bytes that may be unacknowledged; infinity: no limit.
     */
    readonly window: number;
}

export type InitInput = RequestInfo | URL | Response | BufferSource | WebAssembly.Module;

export interface InitOutput {
    readonly memory: WebAssembly.Memory;
    readonly __wbg_bandwidthestimator_free: (a: number, b: number) => void;
    readonly bandwidthestimator_feedback: (a: number, b: number, c: number, d: number) => void;
    readonly bandwidthestimator_loss: (a: number) => number;
    readonly bandwidthestimator_new: (a: number, b: number, c: number, d: number) => number;
    readonly bandwidthestimator_pacing: (a: number) => number;
    readonly bandwidthestimator_rowsCapacity: (a: number) => number;
    readonly bandwidthestimator_rowsPointer: (a: number) => number;
    readonly bandwidthestimator_rttUs: (a: number) => number;
    readonly bandwidthestimator_sent: (a: number, b: number) => void;
    readonly bandwidthestimator_takeProbe: (a: number) => [number, number];
    readonly bandwidthestimator_target: (a: number) => number;
    readonly bandwidthestimator_tick: (a: number, b: number) => void;
    readonly bandwidthestimator_window: (a: number) => number;
    readonly __wbindgen_externrefs: WebAssembly.Table;
    readonly __wbindgen_free: (a: number, b: number, c: number) => void;
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
