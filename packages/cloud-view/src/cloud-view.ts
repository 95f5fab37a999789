/**
 * The cloud on the GPU: takes batches as they arrive, uploads them in the frame loop, and reports what was drawn.
 * Parses nothing and allocates nothing.
 */
import type {
  Batch,
  CloudSource,
  DropCounts,
  DropReason,
  Vector3 as Position,
  Quaternion,
  RobotClient,
} from '@farpoint/operator';
import { BufferGeometry, Points, type RawShaderMaterial, Sphere, Vector3, type WebGLRenderer } from 'three';
import { writePose } from './batch-pose.ts';
import { type CloudColouring, freshnessAt } from './cloud-colouring.ts';
import type { CloudPaint } from './cloud-paint.ts';
import { CloudSurface } from './cloud-surface.ts';
import { type DrawnPoints, type FramePose, readDrawnPoints } from './drawn-points.ts';
import { FrameWindow } from './frame-window.ts';
import { GpuCompletion } from './gpu-completion.ts';
import { PointColouring } from './point-colouring.ts';
import { createPointMaterial, spacingPerMetre } from './point-material.ts';
import { PointRing } from './point-ring.ts';
import { viewportHeightOf } from './renderer-facts.ts';
import { featuresOf, setFeatures } from './shader-features.ts';
import { TileSampler } from './tile-sampler.ts';
import { type UploadEvents, uploadPoints } from './upload-points.ts';
import { WaitingBatches } from './waiting-batches.ts';

/**
 * Points that the ring has room for at first: it grows. Chosen: two clouds of a depth camera, 4 MiB on the
 * GPU.
 */
const FIRST_CAPACITY = 1 << 19;
/** 128 MiB on the GPU. */
const MAX_CAPACITY = 1 << 24;

/** Options of a {@link CloudView}. */
export interface CloudViewOptions {
  /** Number of the sensor whose clouds are drawn; default: the first. */
  sensor?: number;
}

/**
 * The clouds of one of a robot's sensors, as an object of a three.js scene. Its axes are those of the robot's world
 * (REP-103: x forward, z up), so add it to a {@link RobotWorld}. Call {@link update} before each rendering, and
 * {@link noteDrawn} after it.
 */
export class CloudView extends Points<BufferGeometry, RawShaderMaterial> {
  /** Which of the received points are drawn. */
  readonly window = new FrameWindow(FIRST_CAPACITY, MAX_CAPACITY);
  /** Packets that were not drawn, by reason. */
  readonly drops: DropCounts = {};
  /** Frames of which at least one point was drawn, since the session began. */
  frames = 0;
  /** Packets drawn, since the session began. */
  packets = 0;
  /** Points received in the packets drawn, since the session began. */
  points = 0;
  /** The camera's field of view, as the side of its picture at a distance of 1 m, metres; 90° before the first frame. */
  imageExtent = 2;
  /** What the points' colours mean, and between which heights points are drawn. */
  readonly colouring: CloudColouring;
  /** Paints the surface with pictures of the camera that the clouds come from. */
  readonly paint: CloudPaint;
  readonly #colouring: PointColouring;
  #nowMs = 0;
  readonly #renderer: WebGLRenderer;
  readonly #source: CloudSource;
  readonly #completion: GpuCompletion;
  readonly #ring: PointRing;
  readonly #surface: CloudSurface;
  readonly #sampler = new TileSampler();
  readonly #uniforms: ReturnType<typeof createPointMaterial>['uniforms'];
  readonly #waiting: WaitingBatches;
  readonly #take = (batch: Batch) => (batch.hasTiles ? this.#uploadTiles(batch) : this.#uploadPoints(batch));
  readonly #events: UploadEvents = {
    beginFrame: (batch, packet) =>
      this.#beginFrame(batch, packet, this.window.newestSlot, this.window.newestTotal),
    draw: (batch, packet, at) => {
      const { newestFrame, newestSlot } = this.window;
      const slot = batch.frameNumber(packet) === newestFrame ? newestSlot : 1 - newestSlot;
      this.#colouring.sample(batch.points, at, batch.pointsOf(packet), slot);
      this.#noteDrawn(batch, packet);
    },
    drop: (reason) => this.#drop(reason),
  };
  readonly #stop: (() => void)[];

  /**
   * @param renderer the only renderer that draws this object
   * @param source a {@link RobotClient}
   * @param options which sensor's clouds are drawn
   */
  constructor(renderer: WebGLRenderer, source: CloudSource, { sensor = 0 }: CloudViewOptions = {}) {
    const { material, uniforms } = createPointMaterial();
    super(new BufferGeometry(), material);
    this.#renderer = renderer;
    this.#source = source;
    this.#waiting = new WaitingBatches(source);
    this.#completion = new GpuCompletion(renderer);
    this.#uniforms = uniforms;
    this.#colouring = new PointColouring(uniforms);
    this.colouring = this.#colouring;
    uniforms.runs.value = this.window.runs;
    const gl = renderer.getContext() as WebGL2RenderingContext;
    this.#ring = new PointRing(gl, FIRST_CAPACITY, (attribute) => {
      // three's types require a BufferAttribute, but three also draws a GLBufferAttribute.
      this.geometry.setAttribute('position', attribute as never);
    });
    this.#surface = new CloudSurface(renderer, uniforms);
    this.paint = this.#surface.paint;
    this.add(this.#surface);
    this.geometry.boundingSphere = new Sphere(new Vector3(), Number.POSITIVE_INFINITY);
    this.frustumCulled = false;
    this.visible = false;
    const recreate = () => {
      this.#ring.recreate();
      this.window.reset();
      this.#surface.recreate();
    };
    // three's own listener runs first, so its state has been restored by then.
    renderer.domElement.addEventListener('webglcontextrestored', recreate);
    this.#stop = [
      source.on(sensor === 0 ? 'cloud' : `cloud:${sensor}`, (batch) => this.#enqueue(batch)),
      source.on('session', () => this.forget()),
      source.on('phase', (phase) => {
        if (phase === 'none') this.forget();
      }),
      () => renderer.domElement.removeEventListener('webglcontextrestored', recreate),
    ];
  }

  /** Scale of the point size, for the operator's preference: 1 draws points as large as computed. */
  set sizeScale(scale: number) {
    this.#uniforms.sizeScale.value = scale;
  }

  /** Number of vertices that the next display frame draws, including hidden ones of late packets. */
  get drawn(): number {
    return this.window.tail - this.window.head + this.#surface.drawn;
  }

  /** Draws about one of this many samples of a surface. Points are thinned where they are decoded. */
  set every(every: number) {
    this.#surface.every = every;
  }

  /** Whether what is drawn is a surface. */
  get isSurface(): boolean {
    return this.#surface.visible;
  }

  /** The newest frame that has ended: its last packet has arrived, or a newer frame has overtaken it. */
  get endedFrame(): number | null {
    return this.#surface.map.endedFrame ?? this.window.endedFrame;
  }

  /** Position of the newest frame's camera, metres, REP-103 world. */
  get cameraPosition(): Position {
    return this.#uniforms.framePosition.value[this.#newestSlot]!;
  }
  /** Orientation of the newest frame's camera: its optical frame (z forward, x right, y down), a unit quaternion. */
  get cameraOrientation(): Quaternion {
    return this.#uniforms.frameOrientation.value[this.#newestSlot]!;
  }
  /** Number of the newest frame; `null` before the first. */
  get newestFrame(): number | null {
    return this.#surface.map.newestFrame ?? this.window.newestFrame;
  }
  /** Whether any frame has been received in this session. */
  get hasPoints(): boolean {
    return this.newestFrame !== null;
  }

  /** Which of the two poses the newest frame has. */
  get #newestSlot(): number {
    return this.#surface.map.newestFrame === null ? this.window.newestSlot : this.#surface.map.newestSlot & 1;
  }

  /** Height of one eye's picture, pixels. */
  get viewportHeight(): number {
    return viewportHeightOf(this.#renderer);
  }

  /**
   * Uploads the points received. Call it in the frame loop, before rendering.
   * @param nowMs `performance.now()`
   */
  update(nowMs: number): void {
    this.#nowMs = nowMs;
    this.#waiting.drain(this.#take);
    const { head, tail, runCount } = this.window;
    this.#uniforms.runCount.value = runCount;
    this.#uniforms.viewportHeight.value = this.viewportHeight;
    this.#uniforms.freshness.value = freshnessAt(nowMs, this.#source.pointsAtMs);
    this.#colouring.update(nowMs);
    setFeatures(this.material, featuresOf(this.#uniforms));
    this.geometry.setDrawRange(head, tail - head);
    this.#surface.update(nowMs);
    // The surface is a child, so it is drawn only if this is.
    this.visible = tail > head || this.#surface.visible;
  }

  /** Reports when the points that {@link update} uploaded were drawn. Call it in the frame loop, after rendering. */
  noteDrawn(): void {
    // Wait only if the frame is timed, because waiting for the GPU costs frames.
    if (this.#source.latency.wantsTime) this.#completion.wait();
    this.#source.noteDrawn(performance.now());
  }

  /** Frees the GPU's memory and stops listening. */
  override dispose(): void {
    for (const stop of this.#stop) stop();
    this.forget();
    this.removeFromParent();
    this.geometry.dispose();
    this.material.dispose();
    this.#ring.dispose();
    this.#surface.dispose();
  }

  /** Does nothing: the points exist only on the GPU, so rays cannot hit them. */
  override raycast(): void {}

  #enqueue(batch: Batch): void {
    // Hidden pages do not draw.
    if (document.hidden && !this.#renderer.xr.isPresenting) {
      this.#source.release(batch);
      return;
    }
    const dropped = this.#waiting.add(batch);
    if (dropped > 0) this.#drop('page-behind', dropped);
  }

  #drop(reason: DropReason, packets = 1): void {
    this.drops[reason] = (this.drops[reason] ?? 0) + packets;
  }

  /** Discards all points, drawn and waiting: another session begins, or these clouds are no longer wanted. */
  forget(): void {
    this.#waiting.drain(() => undefined);
    this.window.reset();
    this.#surface.forget();
    this.#colouring.forget();
    this.visible = false;
    for (const reason of Object.keys(this.drops)) delete this.drops[reason as DropReason];
    this.frames = 0;
    this.packets = 0;
    this.points = 0;
  }

  /** Copies the drawn points out, for tests: x, y, z, colour int16 each. A surface has none. */
  readBack(): DrawnPoints {
    return readDrawnPoints(this.window, this.#ring);
  }

  /**
   * The pose of a frame that is drawn.
   * @param slot 0 or 1
   */
  pose(slot: number): FramePose {
    return {
      unit: this.#uniforms.frameUnit.value[slot]!,
      position: this.#uniforms.framePosition.value[slot]!,
      orientation: this.#uniforms.frameOrientation.value[slot]!,
    };
  }

  #uploadPoints(batch: Batch): void {
    if (this.#surface.map.newestFrame !== null) this.#surface.forget();
    uploadPoints(batch, this.window, this.#ring, this.#events);
  }

  #noteDrawn(batch: Batch, packet: number): void {
    this.packets++;
    this.points += batch.pointsCame(packet);
    this.#source.noteUploaded(batch, packet);
  }

  #uploadTiles(batch: Batch): void {
    const surface = this.#surface;
    if (this.window.newestFrame !== null) this.window.reset();
    let at = 0;
    for (let packet = 0; packet < batch.packets; packet++) {
      const before = surface.map.newestFrame;
      // Of a frame from before surfaces were wanted.
      if (batch.tilesOf(packet) === 0) this.#drop('superseded');
      else if (surface.take(batch, packet, at, this.#nowMs)) {
        const slot = surface.map.newestSlot & 1;
        if (surface.map.newestFrame !== before) this.#beginFrame(batch, packet, slot, this.#sampler.total);
        this.#sampler.sample(batch, packet, at, this.#colouring, slot);
        this.#noteDrawn(batch, packet);
      } else this.#drop('late');
      at += batch.pointsOf(packet);
    }
  }

  #beginFrame(batch: Batch, packet: number, slot: number, total: number): void {
    this.frames++;
    this.imageExtent = batch.imageExtent(packet);
    this.#colouring.beginFrame(slot, total, this.#nowMs);
    this.#uniforms.frameUnit.value[slot] = batch.unit(packet);
    const spacing = spacingPerMetre(total, this.imageExtent, batch.cover(packet));
    const { framePosition, frameOrientation } = this.#uniforms;
    writePose(batch, packet, framePosition.value[slot]!, spacing, frameOrientation.value[slot]!);
  }
}
