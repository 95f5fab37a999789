/**
 * The cloud on the GPU: takes batches as they come, uploads what is drawn in the frame loop, and tells what was drawn.
 * Nothing is parsed and nothing allocated here.
 */
import { BufferGeometry, Points, Sphere, Vector3 } from 'three';
import type { Batch } from './batch.ts';
import { FrameWindow } from './frame-window.ts';
import { DEFAULT_EXTENT } from './image-extent.ts';
import { countDrop, type DropCounts } from './packet-intake.ts';
import { createPointMaterial, spacingPerMetre } from './point-material.ts';
import { PointRing } from './point-ring.ts';

const FIRST_CAPACITY = 1 << 19;
/** 128 MiB on the GPU. */
const MAX_CAPACITY = 1 << 24;
/** Batches that may wait for the next display frame; beyond it the oldest are dropped. */
const MAX_WAITING = 40;

export interface CloudEvents {
  /** A packet's points were uploaded for this display frame. */
  onPacket(batch: Batch, packet: number): void;
  /** The buffer may go back to the worker. */
  onDone(buffer: ArrayBuffer): void;
}

export class CloudView {
  readonly object: Points;
  readonly window = new FrameWindow(FIRST_CAPACITY, MAX_CAPACITY);
  readonly drops: DropCounts = {};
  /** Frames of which some point was drawn, packets drawn and points that came in them, since the session began. */
  frames = 0;
  packets = 0;
  points = 0;
  readonly #ring: PointRing;
  readonly #geometry = new BufferGeometry();
  readonly #uniforms: ReturnType<typeof createPointMaterial>['uniforms'];
  readonly #waiting: Batch[] = [];
  readonly #events: CloudEvents;

  constructor(gl: WebGL2RenderingContext, events: CloudEvents) {
    this.#events = events;
    this.#ring = new PointRing(gl, FIRST_CAPACITY, (attribute) => {
      // three wants a BufferAttribute by its types; it draws GLBufferAttribute all the same.
      this.#geometry.setAttribute('position', attribute as never);
    });
    this.#geometry.boundingSphere = new Sphere(new Vector3(), Number.POSITIVE_INFINITY);
    const { material, uniforms } = createPointMaterial();
    this.#uniforms = uniforms;
    uniforms.runs.value = this.window.runs;
    this.object = new Points(this.#geometry, material);
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  set viewportHeight(pixels: number) {
    this.#uniforms.viewportHeight.value = pixels;
  }
  set sizeScale(scale: number) {
    this.#uniforms.sizeScale.value = scale;
  }
  set freshness(value: number) {
    this.#uniforms.freshness.value = value;
  }
  /** Vertices that the next frame draws, hidden ones of late packets included. */
  get drawn(): number {
    return this.window.tail - this.window.head;
  }

  /** Of the newest frame: where its camera stood, REP-103 world. */
  get cameraPosition(): { x: number; y: number; z: number } {
    return this.#uniforms.framePosition.value[this.window.newestSlot]!;
  }
  get cameraOrientation(): { x: number; y: number; z: number; w: number } {
    return this.#uniforms.frameOrientation.value[this.window.newestSlot]!;
  }
  /** How wide that camera sees: side of its picture at 1 m, metres. */
  imageExtent = DEFAULT_EXTENT;
  get hasPoints(): boolean {
    return this.window.newestFrame !== null;
  }

  enqueue(batch: Batch): void {
    if (this.#waiting.length >= MAX_WAITING) {
      const oldest = this.#waiting.shift()!;
      countDrop(this.drops, 'page-behind', oldest.packets);
      this.#events.onDone(oldest.buffer);
    }
    this.#waiting.push(batch);
  }

  /** A new session, or none: what was drawn goes. */
  reset(): void {
    for (const batch of this.#waiting) this.#events.onDone(batch.buffer);
    this.#waiting.length = 0;
    this.window.reset();
    this.object.visible = false;
    for (const reason of Object.keys(this.drops)) delete this.drops[reason as keyof DropCounts];
    this.frames = 0;
    this.packets = 0;
    this.points = 0;
  }

  /** After a lost GPU context came back. */
  recreate(): void {
    this.#ring.recreate();
    this.window.reset();
  }

  /** In the frame loop: uploads what has come. */
  update(): void {
    for (let i = 0; i < this.#waiting.length; i++) {
      const batch = this.#waiting[i]!;
      this.#upload(batch);
      this.#events.onDone(batch.buffer);
    }
    this.#waiting.length = 0;
    const { head, tail, runCount } = this.window;
    this.#uniforms.runCount.value = runCount;
    this.#geometry.setDrawRange(head, tail - head);
    this.object.visible = tail > head;
  }

  /** Copies the drawn points out, for tests: x, y, z, colour int16 each. */
  readBack(): { points: Int16Array; slots: (number | null)[] } {
    const points = new Int16Array(this.drawn * 4);
    if (points.length > 0) this.#ring.read(this.window.head, points);
    const slots = Array.from({ length: this.drawn }, (_, i) => this.window.slotOf(this.window.head + i));
    return { points, slots };
  }

  /** Pose of slot 0 or 1, and metres of one step of its coordinates. */
  pose(slot: number): {
    unit: number;
    position: { x: number; y: number; z: number };
    orientation: { x: number; y: number; z: number; w: number };
  } {
    return {
      unit: this.#uniforms.frameUnit.value[slot]!,
      position: this.#uniforms.framePosition.value[slot]!,
      orientation: this.#uniforms.frameOrientation.value[slot]!,
    };
  }

  #upload(batch: Batch): void {
    const { window } = this;
    const move = window.reserve(batch.pointCount);
    if (move !== null) this.#ring.relocate(move);
    // Packets that lie next to each other go in one write.
    let first = 0;
    let count = 0;
    let vertex = window.tail;
    let at = 0;
    for (let packet = 0; packet < batch.packets; packet++) {
      const points = batch.pointsOf(packet);
      const frame = batch.frameNumber(packet);
      const before = window.newestFrame;
      const drop = window.accept(
        frame,
        batch.frameLength(packet),
        batch.sequenceOffset(packet),
        batch.sequenceLength(packet),
        points,
      );
      if (drop === null) {
        if (window.newestFrame !== before) this.#beginFrame(batch, packet);
        count += points;
        this.packets++;
        this.points += batch.pointsCame(packet);
        this.#events.onPacket(batch, packet);
      } else {
        countDrop(this.drops, drop);
        if (count > 0) this.#ring.write(batch.points, first, count, vertex);
        first = at + points;
        count = 0;
        vertex = window.tail;
      }
      at += points;
    }
    if (count > 0) this.#ring.write(batch.points, first, count, vertex);
  }

  #beginFrame(batch: Batch, packet: number): void {
    this.frames++;
    this.imageExtent = batch.imageExtent(packet);
    const slot = this.window.newestSlot;
    this.#uniforms.frameUnit.value[slot] = batch.unit(packet);
    this.#uniforms.framePosition.value[slot]!.set(
      batch.poseComponent(packet, 0),
      batch.poseComponent(packet, 1),
      batch.poseComponent(packet, 2),
      spacingPerMetre(this.window.newestTotal, this.imageExtent, batch.cover(packet)),
    );
    this.#uniforms.frameOrientation.value[slot]!.set(
      batch.poseComponent(packet, 3),
      batch.poseComponent(packet, 4),
      batch.poseComponent(packet, 5),
      batch.poseComponent(packet, 6),
    );
  }
}
