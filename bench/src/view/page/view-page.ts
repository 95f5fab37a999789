/** The page of `pnpm bench view`: decodes packets, draws them, and returns what an eye sees. */
import { CloudView, MemoryView, RobotWorld, worldToThree } from '@farpoint/cloud-view';
import { WorldMemory } from '@farpoint/operator';
import { AssembledCloud } from '@farpoint/operator/testing/assembled-cloud';
import type { Pose } from '@farpoint/protocol';
import { loadCodec } from '@farpoint/wasm-codec';
import { Matrix4, PerspectiveCamera, Quaternion, Scene, Vector3, WebGLRenderer } from 'three';
import { PictureDecoder } from './picture-decoder.ts';
import { PictureDrawer } from './picture-drawer.ts';

/** What a picture is compared by, in base64. */
export interface SeenPicture {
  colour: string;
  depth: string;
  drawMs: number;
}

export interface ViewOptions {
  /** Of an organised stream, base64; `null` for `points64`. */
  header: string | null;
  /** Whether clouds are drawn as surfaces. */
  surface: boolean;
  /** Whether what was seen is remembered. */
  memory: boolean;
  /** Side of the picture, pixels. */
  size: number;
}

/** What the benchmark calls in the page. */
export interface ViewApi {
  begin(options: ViewOptions): Promise<void>;
  /** Takes a frame's packets. Returns the time on the main thread, without decoding, ms. */
  feed(payloads: string[]): number;
  /** Paints with a coded picture. @param codec as WebCodecs names it @param bytes base64 */
  paint(picture: { codec: string; key: boolean; captureTimeUs: number; bytes: string }): Promise<void>;
  /** @param fieldOfView vertical, degrees @param eye pose of the eye's optical frame in the robot's world */
  look(eye: Pose, fieldOfView: number): SeenPicture;
}

declare global {
  interface Window {
    view: ViewApi;
  }
}

/** The optical frame has z forward and y down; three's cameras look along −z with y up. */
const OPTICAL_TO_CAMERA = new Matrix4().makeScale(1, -1, -1);
const RANGE = { near: 0.05, far: 100 };

const canvas = document.querySelector('canvas') as HTMLCanvasElement;
const renderer = new WebGLRenderer({ canvas, antialias: false });
renderer.setClearColor(0x000000, 1);
const scene = new Scene();
const world = new RobotWorld();
scene.add(world);
let source: AssembledCloud | null = null;
let cloud: CloudView | null = null;
let memory: WorldMemory | null = null;
let remembered: MemoryView | null = null;
let drawer: PictureDrawer | null = null;
let decoder: PictureDecoder | null = null;

window.view = {
  async begin({ header, surface, memory: remembers, size }) {
    cloud?.dispose();
    remembered?.dispose();
    memory?.close();
    decoder?.close();
    decoder = null;
    memory = remembers ? new WorldMemory() : null;
    remembered = memory === null ? null : new MemoryView(renderer, memory);
    if (remembered !== null) world.add(remembered);
    renderer.setPixelRatio(1);
    renderer.setSize(size, size);
    source = new AssembledCloud(await loadCodec());
    source.drawSurface(surface);
    if (header !== null) source.beginStream('organised', Uint8Array.fromBase64(header));
    // Before the view, which returns what it has drawn.
    source.on('cloud', (batch) => memory?.take(batch));
    cloud = new CloudView(renderer, source);
    world.add(cloud);
    drawer = new PictureDrawer(renderer, size);
  },
  feed(payloads) {
    source?.take(payloads.map((text) => Uint8Array.fromBase64(text).buffer as ArrayBuffer));
    const beganMs = performance.now();
    cloud?.update(beganMs);
    return performance.now() - beganMs;
  },
  async paint({ codec, key, captureTimeUs, bytes }) {
    decoder ??= new PictureDecoder(codec);
    const frame = await decoder.decode(Uint8Array.fromBase64(bytes), key, captureTimeUs);
    const { displayWidth: width, displayHeight: height } = frame;
    const use = cloud?.paint.take({ image: frame, width, height }, captureTimeUs);
    frame.close();
    if (use !== 'early' && use !== 'no-surface') throw new Error(`the picture is not used: ${use}`);
  },
  look({ position, orientation }, fieldOfView) {
    const camera = new PerspectiveCamera(fieldOfView, 1, RANGE.near, RANGE.far);
    const inWorld = new Matrix4().compose(
      new Vector3(position.x, position.y, position.z),
      new Quaternion(orientation.x, orientation.y, orientation.z, orientation.w),
      new Vector3(1, 1, 1),
    );
    worldToThree()
      .multiply(inWorld)
      .multiply(OPTICAL_TO_CAMERA)
      .decompose(camera.position, camera.quaternion, camera.scale);
    camera.updateMatrixWorld();
    remembered?.update(camera);
    if (cloud === null || drawer === null) throw new Error('begin first');
    const { colour, depth, drawMs } = drawer.draw(scene, camera);
    return { colour: colour.toBase64(), depth: new Uint8Array(depth.buffer).toBase64(), drawMs };
  },
};
