/* tslint:disable */
/* eslint-disable */

/**
 * Packet slots and the points they unpack into.
 */
export class Decoder {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * The number of points of each slot.
     */
    counts_ptr(): number;
    /**
     * Room for `packets` packets, laid out as an encoder's. `undefined` where a full block does not fit into a slot.
     */
    static create(packets: number, stride: number, data_offset: number): Decoder | undefined;
    /**
     * The unpacked points, 8 bytes each.
     */
    points_ptr(): number;
    /**
     * The slots, one after another.
     */
    slots_ptr(): number;
    /**
     * Unpacks the first `packets` slots: the number of points, or −1 − the slot whose count is too large, or −1 − the
     * capacity where `packets` is over it.
     */
    unpack(packets: number): number;
}

/**
 * A frame, the sampler and the packet slots it is packed into.
 */
export class Encoder {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * The indices that the last `sample` chose.
     */
    chosen_ptr(): number;
    /**
     * Room for frames of `capacity` points; a block begins `data_offset` bytes into each `stride` bytes. `undefined` where
     * a full block does not fit into a slot.
     */
    static create(capacity: number, stride: number, data_offset: number): Encoder | undefined;
    /**
     * 4 floats a point.
     */
    frame_ptr(): number;
    /**
     * Packs what the last `sample` chose, nearest bands of depth first where asked; nothing where it failed or there was
     * none.
     */
    pack(near_points_first: boolean, latency_test: boolean): void;
    /**
     * After `sample`: kept; rejected as not finite, for non-positive depth, out of range, not drawn; min depth, max depth.
     * After `pack`, from 7 on: packets, points, saturated.
     */
    report_ptr(): number;
    /**
     * 0, or what was wrong: 1 lambda, 2 epsilon, 3 near distance, 4 more points than the capacity.
     */
    sample(points: number, count: number, lambda: number, epsilon: number, near_distance: number, range: boolean, keep_out_of_range: boolean, seed: bigint): number;
    /**
     * The slots, one after another.
     */
    slots_ptr(): number;
}

/**
 * One packet and the points of all that were decoded since the last `clear`.
 */
export class UnorganisedDecoder {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * Forgets all points.
     */
    clear(): void;
    /**
     * Room for `capacity` points.
     */
    static create(capacity: number): UnorganisedDecoder;
    /**
     * Decodes the first `length` bytes of the packet's memory: the number of points, or minus what was wrong: 1 too
     * short, 2 too long, 3 check value, 4 version, 5 header, 6 data, 7 no room.
     */
    decode(length: number): number;
    /**
     * Three words a packet: first point, count, attribute.
     */
    extents_ptr(): number;
    /**
     * Writes all points as metres, three floats each, and says where.
     */
    metres_ptr(): number;
    /**
     * Where the next packet is to be written, 1200 bytes.
     */
    packet_ptr(): number;
    /**
     * How many packets there are.
     */
    packets_length(): number;
    /**
     * 256 words: what an intensity becomes.
     */
    palette_ptr(): number;
    /**
     * Four floats a packet: origin and step, metres.
     */
    places_ptr(): number;
    /**
     * How many points there are.
     */
    points_length(): number;
    /**
     * The decoded points, four int16 each.
     */
    points_ptr(): number;
    /**
     * Colours as 6-6-4 bits from now on, else 5-6-5.
     */
    set_colour_664(colour_664: boolean): void;
}

/**
 * A frame and the packets it was encoded into.
 */
export class UnorganisedEncoder {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * How much of it there is.
     */
    bytes_length(): number;
    /**
     * The memory in which the last frame's packets lie.
     */
    bytes_ptr(): number;
    /**
     * Room for frames of `capacity` points.
     */
    static create(capacity: number): UnorganisedEncoder;
    /**
     * `attribute`: 0 none, 1 colour, 2 intensity of 8 bits, 3 of 16. `order`: 0 auto, 1 as given, 2 sweep, 3 Morton. A
     * budget of 0 is none. Gives 0, or what was wrong: 1 step, 2 packet bytes, 3 lambda, 4 more points than the capacity.
     */
    encode(points: number, step_mm: number, attribute: number, order: number, max_packet_bytes: number, budget_bytes: number, lambda: number): number;
    /**
     * Offset, length and points of each packet, nearest first.
     */
    extents_ptr(): number;
    /**
     * 4 words a point.
     */
    frame_ptr(): number;
    /**
     * Kept, thinned, not finite, out of range, packets, bytes.
     */
    report_ptr(): number;
}

export type InitInput = RequestInfo | URL | Response | BufferSource | WebAssembly.Module;

export interface InitOutput {
    readonly memory: WebAssembly.Memory;
    readonly __wbg_decoder_free: (a: number, b: number) => void;
    readonly __wbg_encoder_free: (a: number, b: number) => void;
    readonly __wbg_unorganiseddecoder_free: (a: number, b: number) => void;
    readonly __wbg_unorganisedencoder_free: (a: number, b: number) => void;
    readonly decoder_counts_ptr: (a: number) => number;
    readonly decoder_create: (a: number, b: number, c: number) => number;
    readonly decoder_points_ptr: (a: number) => number;
    readonly decoder_slots_ptr: (a: number) => number;
    readonly decoder_unpack: (a: number, b: number) => number;
    readonly encoder_chosen_ptr: (a: number) => number;
    readonly encoder_create: (a: number, b: number, c: number) => number;
    readonly encoder_frame_ptr: (a: number) => number;
    readonly encoder_pack: (a: number, b: number, c: number) => void;
    readonly encoder_report_ptr: (a: number) => number;
    readonly encoder_sample: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number, i: bigint) => number;
    readonly encoder_slots_ptr: (a: number) => number;
    readonly unorganiseddecoder_clear: (a: number) => void;
    readonly unorganiseddecoder_create: (a: number) => number;
    readonly unorganiseddecoder_decode: (a: number, b: number) => number;
    readonly unorganiseddecoder_extents_ptr: (a: number) => number;
    readonly unorganiseddecoder_metres_ptr: (a: number) => number;
    readonly unorganiseddecoder_packet_ptr: (a: number) => number;
    readonly unorganiseddecoder_packets_length: (a: number) => number;
    readonly unorganiseddecoder_palette_ptr: (a: number) => number;
    readonly unorganiseddecoder_places_ptr: (a: number) => number;
    readonly unorganiseddecoder_points_length: (a: number) => number;
    readonly unorganiseddecoder_points_ptr: (a: number) => number;
    readonly unorganiseddecoder_set_colour_664: (a: number, b: number) => void;
    readonly unorganisedencoder_bytes_length: (a: number) => number;
    readonly unorganisedencoder_bytes_ptr: (a: number) => number;
    readonly unorganisedencoder_create: (a: number) => number;
    readonly unorganisedencoder_encode: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number) => number;
    readonly unorganisedencoder_extents_ptr: (a: number) => number;
    readonly unorganisedencoder_frame_ptr: (a: number) => number;
    readonly unorganisedencoder_report_ptr: (a: number) => number;
    readonly __wbindgen_externrefs: WebAssembly.Table;
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
