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
 * A frame of points or a camera's images, the sampler and the packet slots it is packed into.
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
     * 4 bytes a pixel.
     */
    colour_ptr(): number;
    /**
     * Room for frames of `capacity` points; a block begins `data_offset` bytes into each `stride` bytes. `undefined` where
     * a full block does not fit into a slot.
     */
    static create(capacity: number, stride: number, data_offset: number): Encoder | undefined;
    /**
     * A float a pixel.
     */
    depth_ptr(): number;
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
     * Of the frame's first `points` points, or with `images` of the images. 0, or what was wrong: 1 lambda, 2 epsilon,
     * 3 near distance, 4 more points than the capacity, 5 no camera was set.
     */
    sample(images: boolean, points: number, count: number, lambda: number, epsilon: number, near_distance: number, range: boolean, keep_out_of_range: boolean, seed: bigint): number;
    /**
     * Makes the images, for this camera; false where there is none with such numbers or more pixels than the capacity.
     */
    set_camera(width: number, height: number, fx: number, fy: number, cx: number, cy: number): boolean;
    /**
     * The slots, one after another.
     */
    slots_ptr(): number;
}

/**
 * A cloud, or a camera's depth image, and what it says about the floor around the robot.
 */
export class ObstacleGrid {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * The class of each cell.
     */
    classes_ptr(): number;
    /**
     * Room for clouds of `capacity` points. `undefined` where the settings are not valid.
     */
    static create(capacity: number, side: number, cell: number, clearance: number, height: number, drop: number, slope: number, low_ray: number, near_points: number, least_points: number, confirm: boolean): ObstacleGrid | undefined;
    /**
     * A float a pixel.
     */
    depth_ptr(): number;
    /**
     * The height of each cell, as [`Grid::heights`] says.
     */
    heights_ptr(): number;
    /**
     * Judges the first `points` points, or with `image` the image. 0, or what was wrong: 1 the pose, 2 more points than
     * the capacity, 3 no camera was set.
     */
    look(image: boolean, points: number, shift_x: number, shift_y: number): number;
    /**
     * 4 floats a point.
     */
    points_ptr(): number;
    /**
     * The sensor's pose in the grid's frame: the rotation row by row, then the position.
     */
    pose_ptr(): number;
    /**
     * Free and occupied cells, and those without a floor.
     */
    report_ptr(): number;
    /**
     * Makes the image, for this camera; false where there is none with such numbers or more pixels than the capacity.
     */
    set_camera(width: number, height: number, fx: number, fy: number, cx: number, cy: number): boolean;
}

/**
 * Packets of one stream into points.
 */
export class OrganisedDecoder {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * Begins a frame.
     */
    begin(): void;
    /**
     * Colour, 4 bytes a pixel.
     */
    colour_ptr(): number;
    /**
     * Points of the frame so far.
     */
    count(): number;
    /**
     * For the stream of a header; with `images`, depth and colour images too. Check the header before: `undefined` tells
     * nothing.
     */
    static create(header: Uint8Array | number[], images: boolean): OrganisedDecoder | undefined;
    /**
     * Depth in metres, a float a pixel.
     */
    depth_ptr(): number;
    /**
     * 0, or what is wrong with a header: 1 length, 2 magic, 3 version, 4 check value, 5 a value.
     */
    static fault_of(header: Uint8Array | number[]): number;
    /**
     * Image height, pixels.
     */
    height(): number;
    /**
     * True where a packet of the frame was one of a latency test.
     */
    latency_test(): boolean;
    /**
     * Where to write packets: twice 1201 bytes.
     */
    packets_ptr(): number;
    /**
     * Points of the frame, 8 bytes each.
     */
    points_ptr(): number;
    /**
     * Decodes the first packet: the number of points, or −1 too short, −2 too long, −3 check value, −4 reserved, −5 unknown
     * stream, −6 tiles, −7 duplicate, −8 corrupt.
     */
    put(length: number): number;
    /**
     * Decodes both packets. As [`OrganisedDecoder::put`] of the first; of the second [`OrganisedDecoder::second`] tells.
     */
    put_two(length: number, second_length: number): number;
    /**
     * How many samples there are: 0 where the frame is no surface.
     */
    sample_count(): number;
    /**
     * Samples of a surface, 4 bytes each, 256 for each tile of the image.
     */
    samples_ptr(): number;
    /**
     * See [`OrganisedDecoder::put_two`].
     */
    second(): number;
    /**
     * Where the first tile and the number of tiles stand, of each of the packets put last.
     */
    tiles_ptr(): number;
    /**
     * Whether frames that begin from now on are surfaces.
     */
    want_surface(wanted: boolean): void;
    /**
     * Image width, pixels.
     */
    width(): number;
}

/**
 * A frame, its coder and the packet slots it is coded into.
 */
export class OrganisedEncoder {
    private constructor();
    free(): void;
    [Symbol.dispose](): void;
    /**
     * Begins a stream and returns its header: empty where a value is outside its range. With `palette`, the frame's colours
     * become the palette; empty where they are too many.
     */
    begin(id: number, fx: number, fy: number, cx: number, cy: number, palette: boolean, images: boolean): Uint8Array;
    /**
     * What the last frame would take in one packet of any length, bits, coded as most of it was; 0 before `begin`.
     */
    bits_in_one_packet(images: boolean): number;
    /**
     * Whether the frame lies on the camera's grid; as `estimate`.
     */
    check(fx: number, fy: number, cx: number, cy: number): number;
    /**
     * 4 bytes a pixel.
     */
    colour_ptr(): number;
    /**
     * For frames of `width` × `height` pixels; a packet begins `data_offset` bytes into each `stride` bytes. `undefined`
     * where a packet does not fit into a slot or an image has no pixels.
     */
    static create(width: number, height: number, stride: number, data_offset: number): OrganisedEncoder | undefined;
    /**
     * A float a pixel.
     */
    depth_ptr(): number;
    /**
     * Codes the frame with fixed settings. `mode`: 0 no colour, 1 chroma subsampled, 2 full chroma, 3 palette. `density`: of
     * the nearest points' pixels, 1 or more to keep all of those; 0 for no thinning. False before `begin`.
     */
    encode(images: boolean, depth_level: number, mode: number, quality: number, density: number, lambda: number, epsilon: number, near_distance: number): boolean;
    /**
     * Codes the frame in at most so many bytes. False before `begin`.
     */
    encode_within(images: boolean, bytes: number, latency_test: boolean, palette: boolean, lambda: number, epsilon: number, near_distance: number): boolean;
    /**
     * Finds the camera by the frame: 0, or 1 shape, 2 too few points, 3 no camera's focal length, 4 off the grid.
     */
    estimate(): number;
    /**
     * 4 floats a point.
     */
    frame_ptr(): number;
    /**
     * Bytes and points of each packet of the last frame, two numbers a packet.
     */
    lengths_ptr(): number;
    /**
     * After `encode` and `encode_within`: packets, bytes, points; not finite, depth not positive, out of range, thinned,
     * too dense, dropped; depth level, quality, mode, passes. After `estimate` and `check`, from 16 on: fx, fy, cx, cy;
     * or pixels off the grid.
     */
    report_ptr(): number;
    /**
     * The slots of the last frame.
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
    readonly __wbg_obstaclegrid_free: (a: number, b: number) => void;
    readonly __wbg_organiseddecoder_free: (a: number, b: number) => void;
    readonly __wbg_organisedencoder_free: (a: number, b: number) => void;
    readonly __wbg_unorganiseddecoder_free: (a: number, b: number) => void;
    readonly __wbg_unorganisedencoder_free: (a: number, b: number) => void;
    readonly decoder_counts_ptr: (a: number) => number;
    readonly decoder_create: (a: number, b: number, c: number) => number;
    readonly decoder_points_ptr: (a: number) => number;
    readonly decoder_slots_ptr: (a: number) => number;
    readonly decoder_unpack: (a: number, b: number) => number;
    readonly encoder_chosen_ptr: (a: number) => number;
    readonly encoder_colour_ptr: (a: number) => number;
    readonly encoder_create: (a: number, b: number, c: number) => number;
    readonly encoder_depth_ptr: (a: number) => number;
    readonly encoder_frame_ptr: (a: number) => number;
    readonly encoder_pack: (a: number, b: number, c: number) => void;
    readonly encoder_report_ptr: (a: number) => number;
    readonly encoder_sample: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number, i: number, j: bigint) => number;
    readonly encoder_set_camera: (a: number, b: number, c: number, d: number, e: number, f: number, g: number) => number;
    readonly encoder_slots_ptr: (a: number) => number;
    readonly obstaclegrid_classes_ptr: (a: number) => number;
    readonly obstaclegrid_create: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number, i: number, j: number, k: number) => number;
    readonly obstaclegrid_depth_ptr: (a: number) => number;
    readonly obstaclegrid_heights_ptr: (a: number) => number;
    readonly obstaclegrid_look: (a: number, b: number, c: number, d: number, e: number) => number;
    readonly obstaclegrid_points_ptr: (a: number) => number;
    readonly obstaclegrid_pose_ptr: (a: number) => number;
    readonly obstaclegrid_report_ptr: (a: number) => number;
    readonly obstaclegrid_set_camera: (a: number, b: number, c: number, d: number, e: number, f: number, g: number) => number;
    readonly organiseddecoder_begin: (a: number) => void;
    readonly organiseddecoder_colour_ptr: (a: number) => number;
    readonly organiseddecoder_count: (a: number) => number;
    readonly organiseddecoder_create: (a: number, b: number, c: number) => number;
    readonly organiseddecoder_depth_ptr: (a: number) => number;
    readonly organiseddecoder_fault_of: (a: number, b: number) => number;
    readonly organiseddecoder_height: (a: number) => number;
    readonly organiseddecoder_latency_test: (a: number) => number;
    readonly organiseddecoder_packets_ptr: (a: number) => number;
    readonly organiseddecoder_points_ptr: (a: number) => number;
    readonly organiseddecoder_put: (a: number, b: number) => number;
    readonly organiseddecoder_put_two: (a: number, b: number, c: number) => number;
    readonly organiseddecoder_sample_count: (a: number) => number;
    readonly organiseddecoder_samples_ptr: (a: number) => number;
    readonly organiseddecoder_second: (a: number) => number;
    readonly organiseddecoder_tiles_ptr: (a: number) => number;
    readonly organiseddecoder_want_surface: (a: number, b: number) => void;
    readonly organiseddecoder_width: (a: number) => number;
    readonly organisedencoder_begin: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number) => [number, number];
    readonly organisedencoder_bits_in_one_packet: (a: number, b: number) => number;
    readonly organisedencoder_check: (a: number, b: number, c: number, d: number, e: number) => number;
    readonly organisedencoder_colour_ptr: (a: number) => number;
    readonly organisedencoder_create: (a: number, b: number, c: number, d: number) => number;
    readonly organisedencoder_depth_ptr: (a: number) => number;
    readonly organisedencoder_encode: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number, i: number) => number;
    readonly organisedencoder_encode_within: (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number) => number;
    readonly organisedencoder_estimate: (a: number) => number;
    readonly organisedencoder_frame_ptr: (a: number) => number;
    readonly organisedencoder_lengths_ptr: (a: number) => number;
    readonly organisedencoder_report_ptr: (a: number) => number;
    readonly organisedencoder_slots_ptr: (a: number) => number;
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
    readonly __wbindgen_malloc: (a: number, b: number) => number;
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
