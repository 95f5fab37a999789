/** Loads the WASM module, once per thread. */
import init, { type InitInput, initSync, type SyncInitInput } from '../pkg/farpoint_codec.js';
import { CodecError } from './errors.ts';

/** The loaded module, from which encoders and decoders are made. They share its memory. */
export interface Codec {
  /** A `WebAssembly.Memory`: its buffer is replaced when the memory grows. */
  readonly memory: { readonly buffer: ArrayBuffer };
}

/** Where the module comes from: an address, a response, its bytes, or a module compiled elsewhere. */
export type CodecSource = InitInput;

let loading: Promise<Codec> | undefined;

/**
 * Loads the module; later calls on the same thread return the same one, whatever their source. Without a source, a page
 * or worker fetches the file that its bundler put beside the script. Node programs use `@farpoint/wasm-codec/node`.
 *
 * @throws CodecError `not-loadable`
 */
export function loadCodec(source?: CodecSource | Promise<CodecSource>): Promise<Codec> {
  loading ??= load(source);
  return loading;
}

async function load(source: CodecSource | Promise<CodecSource> | undefined): Promise<Codec> {
  try {
    const { memory } = await init({ module_or_path: source ?? besideThisFile() });
    return { memory };
  } catch (error) {
    // A later call may have a better source.
    loading = undefined;
    throw notLoadable(error);
  }
}

/** Written in a form that bundlers recognise, so that they include the file. */
function besideThisFile(): URL {
  return new URL('../pkg/farpoint_codec_bg.wasm', import.meta.url);
}

/**
 * Like {@link loadCodec}, but synchronous, from bytes or a compiled module.
 *
 * @throws CodecError `not-loadable`
 */
export function loadCodecSync(source: SyncInitInput): Codec {
  try {
    const { memory } = initSync({ module: source });
    return { memory };
  } catch (error) {
    throw notLoadable(error);
  }
}

function notLoadable(cause: unknown): CodecError {
  const detail = cause instanceof Error ? cause.message : String(cause);
  return new CodecError('not-loadable', `the point codec's WASM module cannot be loaded: ${detail}`, {
    cause,
  });
}
