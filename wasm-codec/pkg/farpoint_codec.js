/* @ts-self-types="./farpoint_codec.d.ts" */

/**
 * Packet slots and the points they unpack into.
 */
export class Decoder {
    static __wrap(ptr) {
        const obj = Object.create(Decoder.prototype);
        obj.__wbg_ptr = ptr;
        DecoderFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        DecoderFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_decoder_free(ptr, 0);
    }
    /**
     * The number of points of each slot.
     * @returns {number}
     */
    counts_ptr() {
        const ret = wasm.decoder_counts_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Room for `packets` packets, laid out as an encoder's. `undefined` where a full block does not fit into a slot.
     * @param {number} packets
     * @param {number} stride
     * @param {number} data_offset
     * @returns {Decoder | undefined}
     */
    static create(packets, stride, data_offset) {
        const ret = wasm.decoder_create(packets, stride, data_offset);
        return ret === 0 ? undefined : Decoder.__wrap(ret);
    }
    /**
     * The unpacked points, 8 bytes each.
     * @returns {number}
     */
    points_ptr() {
        const ret = wasm.decoder_points_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * The slots, one after another.
     * @returns {number}
     */
    slots_ptr() {
        const ret = wasm.decoder_slots_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Unpacks the first `packets` slots: the number of points, or −1 − the slot whose count is too large, or −1 − the
     * capacity where `packets` is over it.
     * @param {number} packets
     * @returns {number}
     */
    unpack(packets) {
        const ret = wasm.decoder_unpack(this.__wbg_ptr, packets);
        return ret;
    }
}
if (Symbol.dispose) Decoder.prototype[Symbol.dispose] = Decoder.prototype.free;

/**
 * A frame of points or a camera's images, the sampler and the packet slots it is packed into.
 */
export class Encoder {
    static __wrap(ptr) {
        const obj = Object.create(Encoder.prototype);
        obj.__wbg_ptr = ptr;
        EncoderFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        EncoderFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_encoder_free(ptr, 0);
    }
    /**
     * The indices that the last `sample` chose.
     * @returns {number}
     */
    chosen_ptr() {
        const ret = wasm.encoder_chosen_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * 4 bytes a pixel.
     * @returns {number}
     */
    colour_ptr() {
        const ret = wasm.encoder_colour_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Room for frames of `capacity` points; a block begins `data_offset` bytes into each `stride` bytes. `undefined` where
     * a full block does not fit into a slot.
     * @param {number} capacity
     * @param {number} stride
     * @param {number} data_offset
     * @returns {Encoder | undefined}
     */
    static create(capacity, stride, data_offset) {
        const ret = wasm.encoder_create(capacity, stride, data_offset);
        return ret === 0 ? undefined : Encoder.__wrap(ret);
    }
    /**
     * A float a pixel.
     * @returns {number}
     */
    depth_ptr() {
        const ret = wasm.encoder_depth_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * 4 floats a point.
     * @returns {number}
     */
    frame_ptr() {
        const ret = wasm.encoder_frame_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Packs what the last `sample` chose, nearest bands of depth first where asked; nothing where it failed or there was
     * none.
     * @param {boolean} near_points_first
     * @param {boolean} latency_test
     */
    pack(near_points_first, latency_test) {
        wasm.encoder_pack(this.__wbg_ptr, near_points_first, latency_test);
    }
    /**
     * After `sample`: kept; rejected as not finite, for non-positive depth, out of range, not drawn; min depth, max depth.
     * After `pack`, from 7 on: packets, points, saturated.
     * @returns {number}
     */
    report_ptr() {
        const ret = wasm.encoder_report_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Of the frame's first `points` points, or with `images` of the images. 0, or what was wrong: 1 lambda, 2 epsilon,
     * 3 near distance, 4 more points than the capacity, 5 no camera was set.
     * @param {boolean} images
     * @param {number} points
     * @param {number} count
     * @param {number} lambda
     * @param {number} epsilon
     * @param {number} near_distance
     * @param {boolean} range
     * @param {boolean} keep_out_of_range
     * @param {bigint} seed
     * @returns {number}
     */
    sample(images, points, count, lambda, epsilon, near_distance, range, keep_out_of_range, seed) {
        const ret = wasm.encoder_sample(this.__wbg_ptr, images, points, count, lambda, epsilon, near_distance, range, keep_out_of_range, seed);
        return ret >>> 0;
    }
    /**
     * Makes the images, for this camera; false where there is none with such numbers or more pixels than the capacity.
     * @param {number} width
     * @param {number} height
     * @param {number} fx
     * @param {number} fy
     * @param {number} cx
     * @param {number} cy
     * @returns {boolean}
     */
    set_camera(width, height, fx, fy, cx, cy) {
        const ret = wasm.encoder_set_camera(this.__wbg_ptr, width, height, fx, fy, cx, cy);
        return ret !== 0;
    }
    /**
     * The slots, one after another.
     * @returns {number}
     */
    slots_ptr() {
        const ret = wasm.encoder_slots_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
}
if (Symbol.dispose) Encoder.prototype[Symbol.dispose] = Encoder.prototype.free;

/**
 * A cloud, or a camera's depth image, and what it says about the floor around the robot.
 */
export class ObstacleGrid {
    static __wrap(ptr) {
        const obj = Object.create(ObstacleGrid.prototype);
        obj.__wbg_ptr = ptr;
        ObstacleGridFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        ObstacleGridFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_obstaclegrid_free(ptr, 0);
    }
    /**
     * The class of each cell.
     * @returns {number}
     */
    classes_ptr() {
        const ret = wasm.obstaclegrid_classes_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Room for clouds of `capacity` points. `undefined` where the settings are not valid.
     * @param {number} capacity
     * @param {number} side
     * @param {number} cell
     * @param {number} clearance
     * @param {number} height
     * @param {number} drop
     * @param {number} slope
     * @param {number} low_ray
     * @param {number} near_points
     * @param {number} least_points
     * @param {boolean} confirm
     * @returns {ObstacleGrid | undefined}
     */
    static create(capacity, side, cell, clearance, height, drop, slope, low_ray, near_points, least_points, confirm) {
        const ret = wasm.obstaclegrid_create(capacity, side, cell, clearance, height, drop, slope, low_ray, near_points, least_points, confirm);
        return ret === 0 ? undefined : ObstacleGrid.__wrap(ret);
    }
    /**
     * A float a pixel.
     * @returns {number}
     */
    depth_ptr() {
        const ret = wasm.obstaclegrid_depth_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * The height of each cell, as [`Grid::heights`] says.
     * @returns {number}
     */
    heights_ptr() {
        const ret = wasm.obstaclegrid_heights_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Judges the first `points` points, or with `image` the image. 0, or what was wrong: 1 the pose, 2 more points than
     * the capacity, 3 no camera was set.
     * @param {boolean} image
     * @param {number} points
     * @param {number} shift_x
     * @param {number} shift_y
     * @returns {number}
     */
    look(image, points, shift_x, shift_y) {
        const ret = wasm.obstaclegrid_look(this.__wbg_ptr, image, points, shift_x, shift_y);
        return ret >>> 0;
    }
    /**
     * 4 floats a point.
     * @returns {number}
     */
    points_ptr() {
        const ret = wasm.obstaclegrid_points_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * The sensor's pose in the grid's frame: the rotation row by row, then the position.
     * @returns {number}
     */
    pose_ptr() {
        const ret = wasm.obstaclegrid_pose_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Free and occupied cells, and those without a floor.
     * @returns {number}
     */
    report_ptr() {
        const ret = wasm.obstaclegrid_report_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Makes the image, for this camera; false where there is none with such numbers or more pixels than the capacity.
     * @param {number} width
     * @param {number} height
     * @param {number} fx
     * @param {number} fy
     * @param {number} cx
     * @param {number} cy
     * @returns {boolean}
     */
    set_camera(width, height, fx, fy, cx, cy) {
        const ret = wasm.obstaclegrid_set_camera(this.__wbg_ptr, width, height, fx, fy, cx, cy);
        return ret !== 0;
    }
}
if (Symbol.dispose) ObstacleGrid.prototype[Symbol.dispose] = ObstacleGrid.prototype.free;

/**
 * Packets of one stream into points.
 */
export class OrganisedDecoder {
    static __wrap(ptr) {
        const obj = Object.create(OrganisedDecoder.prototype);
        obj.__wbg_ptr = ptr;
        OrganisedDecoderFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        OrganisedDecoderFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_organiseddecoder_free(ptr, 0);
    }
    /**
     * Begins a frame.
     */
    begin() {
        wasm.organiseddecoder_begin(this.__wbg_ptr);
    }
    /**
     * Colour, 4 bytes a pixel.
     * @returns {number}
     */
    colour_ptr() {
        const ret = wasm.organiseddecoder_colour_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Points of the frame so far.
     * @returns {number}
     */
    count() {
        const ret = wasm.organiseddecoder_count(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * For the stream of a header; with `images`, depth and colour images too. Check the header before: `undefined` tells
     * nothing.
     * @param {Uint8Array | number[]} header
     * @param {boolean} images
     * @returns {OrganisedDecoder | undefined}
     */
    static create(header, images) {
        const val2 = +images;
        const ptr0 = passArray8ToWasm0(header, wasm.__wbindgen_malloc);
        const len0 = WASM_VECTOR_LEN;
        const ret = wasm.organiseddecoder_create(ptr0, len0, val2);
        return ret === 0 ? undefined : OrganisedDecoder.__wrap(ret);
    }
    /**
     * Depth in metres, a float a pixel.
     * @returns {number}
     */
    depth_ptr() {
        const ret = wasm.organiseddecoder_depth_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * 0, or what is wrong with a header: 1 length, 2 magic, 3 version, 4 check value, 5 a value.
     * @param {Uint8Array | number[]} header
     * @returns {number}
     */
    static fault_of(header) {
        const ptr0 = passArray8ToWasm0(header, wasm.__wbindgen_malloc);
        const len0 = WASM_VECTOR_LEN;
        const ret = wasm.organiseddecoder_fault_of(ptr0, len0);
        return ret >>> 0;
    }
    /**
     * Image height, pixels.
     * @returns {number}
     */
    height() {
        const ret = wasm.organiseddecoder_height(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * True where a packet of the frame was one of a latency test.
     * @returns {boolean}
     */
    latency_test() {
        const ret = wasm.organiseddecoder_latency_test(this.__wbg_ptr);
        return ret !== 0;
    }
    /**
     * Where to write packets: twice 1201 bytes.
     * @returns {number}
     */
    packets_ptr() {
        const ret = wasm.organiseddecoder_packets_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Points of the frame, 8 bytes each.
     * @returns {number}
     */
    points_ptr() {
        const ret = wasm.organiseddecoder_points_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Decodes the first packet: the number of points, or −1 too short, −2 too long, −3 check value, −4 reserved, −5 unknown
     * stream, −6 tiles, −7 duplicate, −8 corrupt.
     * @param {number} length
     * @returns {number}
     */
    put(length) {
        const ret = wasm.organiseddecoder_put(this.__wbg_ptr, length);
        return ret;
    }
    /**
     * Decodes both packets. As [`OrganisedDecoder::put`] of the first; of the second [`OrganisedDecoder::second`] tells.
     * @param {number} length
     * @param {number} second_length
     * @returns {number}
     */
    put_two(length, second_length) {
        const ret = wasm.organiseddecoder_put_two(this.__wbg_ptr, length, second_length);
        return ret;
    }
    /**
     * How many samples there are: 0 where the frame is no surface.
     * @returns {number}
     */
    sample_count() {
        const ret = wasm.organiseddecoder_sample_count(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Samples of a surface, 4 bytes each, 256 for each tile of the image.
     * @returns {number}
     */
    samples_ptr() {
        const ret = wasm.organiseddecoder_samples_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * See [`OrganisedDecoder::put_two`].
     * @returns {number}
     */
    second() {
        const ret = wasm.organiseddecoder_second(this.__wbg_ptr);
        return ret;
    }
    /**
     * Where the first tile and the number of tiles stand, of each of the packets put last.
     * @returns {number}
     */
    tiles_ptr() {
        const ret = wasm.organiseddecoder_tiles_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Whether frames that begin from now on are surfaces.
     * @param {boolean} wanted
     */
    want_surface(wanted) {
        wasm.organiseddecoder_want_surface(this.__wbg_ptr, wanted);
    }
    /**
     * Image width, pixels.
     * @returns {number}
     */
    width() {
        const ret = wasm.organiseddecoder_width(this.__wbg_ptr);
        return ret >>> 0;
    }
}
if (Symbol.dispose) OrganisedDecoder.prototype[Symbol.dispose] = OrganisedDecoder.prototype.free;

/**
 * A frame, its coder and the packet slots it is coded into.
 */
export class OrganisedEncoder {
    static __wrap(ptr) {
        const obj = Object.create(OrganisedEncoder.prototype);
        obj.__wbg_ptr = ptr;
        OrganisedEncoderFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        OrganisedEncoderFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_organisedencoder_free(ptr, 0);
    }
    /**
     * Begins a stream and returns its header: empty where a value is outside its range. With `palette`, the frame's colours
     * become the palette; empty where they are too many.
     * @param {number} id
     * @param {number} fx
     * @param {number} fy
     * @param {number} cx
     * @param {number} cy
     * @param {boolean} palette
     * @param {boolean} images
     * @returns {Uint8Array}
     */
    begin(id, fx, fy, cx, cy, palette, images) {
        const ret = wasm.organisedencoder_begin(this.__wbg_ptr, id, fx, fy, cx, cy, palette, images);
        var v1 = getArrayU8FromWasm0(ret[0], ret[1]).slice();
        wasm.__wbindgen_free(ret[0], ret[1] * 1, 1);
        return v1;
    }
    /**
     * What the last frame would take in one packet of any length, bits, coded as most of it was; 0 before `begin`.
     * @param {boolean} images
     * @returns {number}
     */
    bits_in_one_packet(images) {
        const ret = wasm.organisedencoder_bits_in_one_packet(this.__wbg_ptr, images);
        return ret;
    }
    /**
     * Whether the frame lies on the camera's grid; as `estimate`.
     * @param {number} fx
     * @param {number} fy
     * @param {number} cx
     * @param {number} cy
     * @returns {number}
     */
    check(fx, fy, cx, cy) {
        const ret = wasm.organisedencoder_check(this.__wbg_ptr, fx, fy, cx, cy);
        return ret >>> 0;
    }
    /**
     * 4 bytes a pixel.
     * @returns {number}
     */
    colour_ptr() {
        const ret = wasm.organisedencoder_colour_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * For frames of `width` × `height` pixels; a packet begins `data_offset` bytes into each `stride` bytes. `undefined`
     * where a packet does not fit into a slot or an image has no pixels.
     * @param {number} width
     * @param {number} height
     * @param {number} stride
     * @param {number} data_offset
     * @returns {OrganisedEncoder | undefined}
     */
    static create(width, height, stride, data_offset) {
        const ret = wasm.organisedencoder_create(width, height, stride, data_offset);
        return ret === 0 ? undefined : OrganisedEncoder.__wrap(ret);
    }
    /**
     * A float a pixel.
     * @returns {number}
     */
    depth_ptr() {
        const ret = wasm.organisedencoder_depth_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Codes the frame with fixed settings. `mode`: 0 no colour, 1 chroma subsampled, 2 full chroma, 3 palette. `density`: of
     * the nearest points' pixels, 1 or more to keep all of those; 0 for no thinning. False before `begin`.
     * @param {boolean} images
     * @param {number} depth_level
     * @param {number} mode
     * @param {number} quality
     * @param {number} density
     * @param {number} lambda
     * @param {number} epsilon
     * @param {number} near_distance
     * @returns {boolean}
     */
    encode(images, depth_level, mode, quality, density, lambda, epsilon, near_distance) {
        const ret = wasm.organisedencoder_encode(this.__wbg_ptr, images, depth_level, mode, quality, density, lambda, epsilon, near_distance);
        return ret !== 0;
    }
    /**
     * Codes the frame in at most so many bytes. False before `begin`.
     * @param {boolean} images
     * @param {number} bytes
     * @param {boolean} latency_test
     * @param {boolean} palette
     * @param {number} lambda
     * @param {number} epsilon
     * @param {number} near_distance
     * @returns {boolean}
     */
    encode_within(images, bytes, latency_test, palette, lambda, epsilon, near_distance) {
        const ret = wasm.organisedencoder_encode_within(this.__wbg_ptr, images, bytes, latency_test, palette, lambda, epsilon, near_distance);
        return ret !== 0;
    }
    /**
     * Finds the camera by the frame: 0, or 1 shape, 2 too few points, 3 no camera's focal length, 4 off the grid.
     * @returns {number}
     */
    estimate() {
        const ret = wasm.organisedencoder_estimate(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * 4 floats a point.
     * @returns {number}
     */
    frame_ptr() {
        const ret = wasm.organisedencoder_frame_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Bytes and points of each packet of the last frame, two numbers a packet.
     * @returns {number}
     */
    lengths_ptr() {
        const ret = wasm.organisedencoder_lengths_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * After `encode` and `encode_within`: packets, bytes, points; not finite, depth not positive, out of range, thinned,
     * too dense, dropped; depth level, quality, mode, passes. After `estimate` and `check`, from 16 on: fx, fy, cx, cy;
     * or pixels off the grid.
     * @returns {number}
     */
    report_ptr() {
        const ret = wasm.organisedencoder_report_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * The slots of the last frame.
     * @returns {number}
     */
    slots_ptr() {
        const ret = wasm.organisedencoder_slots_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
}
if (Symbol.dispose) OrganisedEncoder.prototype[Symbol.dispose] = OrganisedEncoder.prototype.free;

/**
 * One packet and the points of all that were decoded since the last `clear`.
 */
export class UnorganisedDecoder {
    static __wrap(ptr) {
        const obj = Object.create(UnorganisedDecoder.prototype);
        obj.__wbg_ptr = ptr;
        UnorganisedDecoderFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        UnorganisedDecoderFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_unorganiseddecoder_free(ptr, 0);
    }
    /**
     * Forgets all points.
     */
    clear() {
        wasm.unorganiseddecoder_clear(this.__wbg_ptr);
    }
    /**
     * Room for `capacity` points.
     * @param {number} capacity
     * @returns {UnorganisedDecoder}
     */
    static create(capacity) {
        const ret = wasm.unorganiseddecoder_create(capacity);
        return UnorganisedDecoder.__wrap(ret);
    }
    /**
     * Decodes the first `length` bytes of the packet's memory: the number of points, or minus what was wrong: 1 too
     * short, 2 too long, 3 check value, 4 version, 5 header, 6 data, 7 no room.
     * @param {number} length
     * @returns {number}
     */
    decode(length) {
        const ret = wasm.unorganiseddecoder_decode(this.__wbg_ptr, length);
        return ret;
    }
    /**
     * Three words a packet: first point, count, attribute.
     * @returns {number}
     */
    extents_ptr() {
        const ret = wasm.unorganiseddecoder_extents_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Writes all points as metres, three floats each, and says where.
     * @returns {number}
     */
    metres_ptr() {
        const ret = wasm.unorganiseddecoder_metres_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Where the next packet is to be written, 1200 bytes.
     * @returns {number}
     */
    packet_ptr() {
        const ret = wasm.unorganiseddecoder_packet_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * How many packets there are.
     * @returns {number}
     */
    packets_length() {
        const ret = wasm.unorganiseddecoder_packets_length(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * 256 words: what an intensity becomes.
     * @returns {number}
     */
    palette_ptr() {
        const ret = wasm.unorganiseddecoder_palette_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Four floats a packet: origin and step, metres.
     * @returns {number}
     */
    places_ptr() {
        const ret = wasm.unorganiseddecoder_places_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * How many points there are.
     * @returns {number}
     */
    points_length() {
        const ret = wasm.unorganiseddecoder_points_length(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * The decoded points, four int16 each.
     * @returns {number}
     */
    points_ptr() {
        const ret = wasm.unorganiseddecoder_points_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Colours as 6-6-4 bits from now on, else 5-6-5.
     * @param {boolean} colour_664
     */
    set_colour_664(colour_664) {
        wasm.unorganiseddecoder_set_colour_664(this.__wbg_ptr, colour_664);
    }
}
if (Symbol.dispose) UnorganisedDecoder.prototype[Symbol.dispose] = UnorganisedDecoder.prototype.free;

/**
 * A frame and the packets it was encoded into.
 */
export class UnorganisedEncoder {
    static __wrap(ptr) {
        const obj = Object.create(UnorganisedEncoder.prototype);
        obj.__wbg_ptr = ptr;
        UnorganisedEncoderFinalization.register(obj, obj.__wbg_ptr, obj);
        return obj;
    }
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        UnorganisedEncoderFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_unorganisedencoder_free(ptr, 0);
    }
    /**
     * How much of it there is.
     * @returns {number}
     */
    bytes_length() {
        const ret = wasm.unorganisedencoder_bytes_length(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * The memory in which the last frame's packets lie.
     * @returns {number}
     */
    bytes_ptr() {
        const ret = wasm.unorganisedencoder_bytes_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Room for frames of `capacity` points.
     * @param {number} capacity
     * @returns {UnorganisedEncoder}
     */
    static create(capacity) {
        const ret = wasm.unorganisedencoder_create(capacity);
        return UnorganisedEncoder.__wrap(ret);
    }
    /**
     * `attribute`: 0 none, 1 colour, 2 intensity of 8 bits, 3 of 16. `order`: 0 auto, 1 as given, 2 sweep, 3 Morton. A
     * budget of 0 is none. Gives 0, or what was wrong: 1 step, 2 packet bytes, 3 lambda, 4 more points than the capacity.
     * @param {number} points
     * @param {number} step_mm
     * @param {number} attribute
     * @param {number} order
     * @param {number} max_packet_bytes
     * @param {number} budget_bytes
     * @param {number} lambda
     * @returns {number}
     */
    encode(points, step_mm, attribute, order, max_packet_bytes, budget_bytes, lambda) {
        const ret = wasm.unorganisedencoder_encode(this.__wbg_ptr, points, step_mm, attribute, order, max_packet_bytes, budget_bytes, lambda);
        return ret >>> 0;
    }
    /**
     * Offset, length and points of each packet, nearest first.
     * @returns {number}
     */
    extents_ptr() {
        const ret = wasm.unorganisedencoder_extents_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * 4 words a point.
     * @returns {number}
     */
    frame_ptr() {
        const ret = wasm.unorganisedencoder_frame_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Kept, thinned, not finite, out of range, packets, bytes.
     * @returns {number}
     */
    report_ptr() {
        const ret = wasm.unorganisedencoder_report_ptr(this.__wbg_ptr);
        return ret >>> 0;
    }
}
if (Symbol.dispose) UnorganisedEncoder.prototype[Symbol.dispose] = UnorganisedEncoder.prototype.free;
function __wbg_get_imports() {
    const import0 = {
        __proto__: null,
        __wbg___wbindgen_throw_4c88d8bf264fd984: function(arg0, arg1) {
            throw new Error(getStringFromWasm0(arg0, arg1));
        },
        __wbindgen_init_externref_table: function() {
            const table = wasm.__wbindgen_externrefs;
            table.set(0, undefined);
            table.set(1024, undefined);
            table.set(1025, null);
            table.set(1026, true);
            table.set(1027, false);
        },
    };
    return {
        __proto__: null,
        "./farpoint_codec_bg.js": import0,
    };
}

const DecoderFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_decoder_free(ptr, 1));
const EncoderFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_encoder_free(ptr, 1));
const ObstacleGridFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_obstaclegrid_free(ptr, 1));
const OrganisedDecoderFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_organiseddecoder_free(ptr, 1));
const OrganisedEncoderFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_organisedencoder_free(ptr, 1));
const UnorganisedDecoderFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_unorganiseddecoder_free(ptr, 1));
const UnorganisedEncoderFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_unorganisedencoder_free(ptr, 1));

function getArrayU8FromWasm0(ptr, len) {
    ptr = ptr >>> 0;
    return getUint8ArrayMemory0().subarray(ptr / 1, ptr / 1 + len);
}

function getStringFromWasm0(ptr, len) {
    ptr = ptr >>> 0;
    return decodeText(getUint8ArrayMemory0().subarray(ptr, ptr + len));
}

let cachedUint8ArrayMemory0 = null;
function getUint8ArrayMemory0() {
    if (cachedUint8ArrayMemory0 === null || cachedUint8ArrayMemory0.byteLength === 0) {
        cachedUint8ArrayMemory0 = new Uint8Array(wasm.memory.buffer);
    }
    return cachedUint8ArrayMemory0;
}

function passArray8ToWasm0(arg, malloc) {
    const ptr = malloc(arg.length * 1, 1) >>> 0;
    getUint8ArrayMemory0().set(arg, ptr / 1);
    WASM_VECTOR_LEN = arg.length;
    return ptr;
}

let cachedTextDecoder = new TextDecoder('utf-8', { ignoreBOM: true });
cachedTextDecoder.decode();
const MAX_SAFARI_DECODE_BYTES = 2146435072;
let numBytesDecoded = 0;
function decodeText(bytes) {
    numBytesDecoded += bytes.length;
    if (numBytesDecoded >= MAX_SAFARI_DECODE_BYTES) {
        cachedTextDecoder = new TextDecoder('utf-8', { ignoreBOM: true });
        cachedTextDecoder.decode();
        numBytesDecoded = bytes.length;
    }
    return cachedTextDecoder.decode(bytes);
}

let WASM_VECTOR_LEN = 0;

let wasmModule, wasmInstance, wasm;
function __wbg_finalize_init(instance, module) {
    wasmInstance = instance;
    wasm = instance.exports;
    wasmModule = module;
    cachedUint8ArrayMemory0 = null;
    wasm.__wbindgen_start();
    return wasm;
}

async function __wbg_load(module, imports) {
    if (typeof Response === 'function' && module instanceof Response) {
        if (!module.ok) {
            throw new Error(`failed to fetch Wasm: ${module.status} ${module.statusText} fetching '${module.url}'`);
        }

        if (typeof WebAssembly.instantiateStreaming === 'function') {
            try {
                return await WebAssembly.instantiateStreaming(module, imports);
            } catch (e) {
                const validResponse = expectedResponseType(module.type);

                if (validResponse && module.headers.get('Content-Type') !== 'application/wasm') {
                    console.warn("`WebAssembly.instantiateStreaming` failed because your server does not serve Wasm with `application/wasm` MIME type. Falling back to `WebAssembly.instantiate` which is slower. Original error:\n", e);

                } else { throw e; }
            }
        }

        const bytes = await module.arrayBuffer();
        return await WebAssembly.instantiate(bytes, imports);
    } else {
        const instance = await WebAssembly.instantiate(module, imports);

        if (instance instanceof WebAssembly.Instance) {
            return { instance, module };
        } else {
            return instance;
        }
    }

    function expectedResponseType(type) {
        switch (type) {
            case 'basic': case 'cors': case 'default': return true;
        }
        return false;
    }
}

function initSync(module) {
    if (wasm !== undefined) return wasm;


    if (module !== undefined) {
        if (Object.getPrototypeOf(module) === Object.prototype) {
            ({module} = module)
        } else {
            console.warn('using deprecated parameters for `initSync()`; pass a single object instead')
        }
    }

    const imports = __wbg_get_imports();
    if (!(module instanceof WebAssembly.Module)) {
        module = new WebAssembly.Module(module);
    }
    const instance = new WebAssembly.Instance(module, imports);
    return __wbg_finalize_init(instance, module);
}

let __wbg_init_promise;
async function __wbg_init(module_or_path) {
    if (wasm !== undefined) return wasm;
    if (__wbg_init_promise === undefined) {
        __wbg_init_promise = __wbg_init_once(module_or_path);
        __wbg_init_promise.catch(() => { __wbg_init_promise = undefined; });
    }
    return __wbg_init_promise;
}

async function __wbg_init_once(module_or_path) {

    if (module_or_path !== undefined) {
        if (Object.getPrototypeOf(module_or_path) === Object.prototype) {
            ({module_or_path} = module_or_path)
        } else {
            console.warn('using deprecated parameters for the initialization function; pass a single object instead')
        }
    }


    const imports = __wbg_get_imports();

    if (typeof module_or_path === 'string' || (typeof Request === 'function' && module_or_path instanceof Request) || (typeof URL === 'function' && module_or_path instanceof URL)) {
        module_or_path = fetch(module_or_path);
    }

    const { instance, module } = await __wbg_load(await module_or_path, imports);

    return __wbg_finalize_init(instance, module);
}

export { initSync, __wbg_init as default };
