/** What the Cargo workspace `wasm-codec/` builds for JavaScript, and where it goes. */

export interface WasmCrate {
  /** The Cargo package. */
  package: string;
  /** The library's name: `<name>.js` and `<name>_bg.wasm` are written. */
  name: string;
  /** Folder of the committed files, from the repository's root. */
  outDir: string;
  /** The crates (folders of `wasm-codec/crates`) whose sources are part of the module. */
  crates: readonly string[];
}

/** The Cargo workspace, from the repository's root. */
export const CARGO_WORKSPACE = 'wasm-codec';

export const WASM_CRATES: readonly WasmCrate[] = [
  {
    package: 'farpoint-codec-wasm',
    name: 'farpoint_codec',
    outDir: 'wasm-codec/pkg',
    crates: ['point-codec', 'obstacle-grid', 'organised-codec', 'unorganised-codec', 'codec-wasm'],
  },
  {
    package: 'farpoint-sim-camera',
    name: 'farpoint_sim_camera',
    outDir: 'packages/sim/wasm',
    crates: ['sim-camera'],
  },
  {
    package: 'farpoint-picture-codec',
    name: 'farpoint_picture_codec',
    outDir: 'packages/pictures/wasm',
    crates: ['picture-codec'],
  },
];
