/* @ts-self-types="./farpoint_bandwidth_estimator.d.ts" */

/**
 * One path's controller.
 */
export class BandwidthEstimator {
    __destroy_into_raw() {
        const ptr = this.__wbg_ptr;
        this.__wbg_ptr = 0;
        BandwidthEstimatorFinalization.unregister(this);
        return ptr;
    }
    free() {
        const ptr = this.__destroy_into_raw();
        wasm.__wbg_bandwidthestimator_free(ptr, 0);
    }
    /**
     * The first `count` rows are one feedback message (see `RESULT_ROW`).
     * @param {number} count
     * @param {number} in_flight
     * @param {number} now_us
     */
    feedback(count, in_flight, now_us) {
        wasm.bandwidthestimator_feedback(this.__wbg_ptr, count, in_flight, now_us);
    }
    /**
     * Of the packets sent, 0–1.
     * @returns {number}
     */
    get loss() {
        const ret = wasm.bandwidthestimator_loss(this.__wbg_ptr);
        return ret;
    }
    /**
     * Begins at `start_bps`, between the other two.
     * @param {number} start_bps
     * @param {number} min_bps
     * @param {number} max_bps
     * @param {number} now_us
     */
    constructor(start_bps, min_bps, max_bps, now_us) {
        const ret = wasm.bandwidthestimator_new(start_bps, min_bps, max_bps, now_us);
        this.__wbg_ptr = ret;
        BandwidthEstimatorFinalization.register(this, this.__wbg_ptr, this);
        return this;
    }
    /**
     * How fast packets may leave.
     * @returns {number}
     */
    get pacing() {
        const ret = wasm.bandwidthestimator_pacing(this.__wbg_ptr);
        return ret;
    }
    /**
     * How many rows fit.
     * @returns {number}
     */
    rowsCapacity() {
        const ret = wasm.bandwidthestimator_rowsCapacity(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Where the rows are written before `sent` and `feedback`; an offset into the module's memory.
     * @returns {number}
     */
    rowsPointer() {
        const ret = wasm.bandwidthestimator_rowsPointer(this.__wbg_ptr);
        return ret >>> 0;
    }
    /**
     * Round trip; NaN before the first.
     * @returns {number}
     */
    get rttUs() {
        const ret = wasm.bandwidthestimator_rttUs(this.__wbg_ptr);
        return ret;
    }
    /**
     * The first `count` rows are packets that left (see `SENT_ROW`), in order.
     * @param {number} count
     */
    sent(count) {
        wasm.bandwidthestimator_sent(this.__wbg_ptr, count);
    }
    /**
     * Takes the next wish for a probe: cluster (from 1), bit/s, bytes. Empty where there is none.
     * @returns {Float64Array}
     */
    takeProbe() {
        const ret = wasm.bandwidthestimator_takeProbe(this.__wbg_ptr);
        var v1 = getArrayF64FromWasm0(ret[0], ret[1]).slice();
        wasm.__wbindgen_free(ret[0], ret[1] * 8, 8);
        return v1;
    }
    /**
     * What media may use.
     * @returns {number}
     */
    get target() {
        const ret = wasm.bandwidthestimator_target(this.__wbg_ptr);
        return ret;
    }
    /**
     * To be called every 25 ms or more often.
     * @param {number} now_us
     */
    tick(now_us) {
        wasm.bandwidthestimator_tick(this.__wbg_ptr, now_us);
    }
    /**
     * Bytes that may be unacknowledged; infinity: no limit.
     * @returns {number}
     */
    get window() {
        const ret = wasm.bandwidthestimator_window(this.__wbg_ptr);
        return ret;
    }
}
if (Symbol.dispose) BandwidthEstimator.prototype[Symbol.dispose] = BandwidthEstimator.prototype.free;
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
        "./farpoint_bandwidth_estimator_bg.js": import0,
    };
}

const BandwidthEstimatorFinalization = (typeof FinalizationRegistry === 'undefined')
    ? { register: () => {}, unregister: () => {} }
    : new FinalizationRegistry(ptr => wasm.__wbg_bandwidthestimator_free(ptr, 1));

function getArrayF64FromWasm0(ptr, len) {
    ptr = ptr >>> 0;
    return getFloat64ArrayMemory0().subarray(ptr / 8, ptr / 8 + len);
}

let cachedFloat64ArrayMemory0 = null;
function getFloat64ArrayMemory0() {
    if (cachedFloat64ArrayMemory0 === null || cachedFloat64ArrayMemory0.byteLength === 0) {
        cachedFloat64ArrayMemory0 = new Float64Array(wasm.memory.buffer);
    }
    return cachedFloat64ArrayMemory0;
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

let wasmModule, wasmInstance, wasm;
function __wbg_finalize_init(instance, module) {
    wasmInstance = instance;
    wasm = instance.exports;
    wasmModule = module;
    cachedFloat64ArrayMemory0 = null;
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
