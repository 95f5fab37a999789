/** Renderer, scene and cameras. The frame loop only uploads new data, places the camera and draws. */

import { bodyYaw, type CloudView, opticalYaw, RobotWorld } from '@farpoint/cloud-view';
import { type RobotBody, shortestTurn } from '@farpoint/protocol';
import {
  BoxGeometry,
  BufferGeometry,
  type Camera,
  Color,
  EdgesGeometry,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Scene,
  WebGLRenderer,
} from 'three';
import { DEFAULT_HEADSET, type HeadsetSettings } from '../../ground/headset-settings.ts';
import { FrontPointer } from '../headset/front-pointer.ts';
import { HeadsetRig } from '../headset/headset-rig.ts';
import { Vignette } from '../headset/vignette.ts';
import { PoseFollower } from '../pose-follower.ts';
import { RobotFigures } from '../robot-model/robot-figures.ts';
import { bearingOnScreen } from './blocked-edge.ts';
import { DrivePath } from './drive-path.ts';
import { FloorMap } from './floor-map.ts';
import { GroundGrid } from './ground-grid.ts';
import { DEFAULT_FOV, Look } from './look.ts';
import { NearRing } from './near-ring.ts';
import { PlannedPathLine } from './planned-path-line.ts';
import { PointerRings } from './pointer-rings.ts';
import type { PredictedView } from './predicted-view.ts';
import { RobotGhost } from './robot-ghost.ts';
import { TopDownCamera } from './top-down-camera.ts';

/** Footprint of a small wheeled robot, metres. */
const LENGTH = 0.5;
const WIDTH = 0.4;
const HEIGHT = 0.25;

/** A plain outline of the robot and its heading. */
class RobotMarker {
  /** In the world's axes (REP-103), at base_link. */
  readonly object = new Group();
  readonly #outline: LineBasicMaterial;
  readonly #heading: MeshBasicMaterial;
  readonly #box: LineSegments;

  constructor() {
    this.#outline = new LineBasicMaterial({ color: 0x35c9b5, transparent: true, opacity: 0.8 });
    this.#heading = new MeshBasicMaterial({ color: 0x35c9b5, transparent: true, opacity: 0.7 });
    const box = new EdgesGeometry(new BoxGeometry(LENGTH, WIDTH, HEIGHT));
    const outline = new LineSegments(box, this.#outline);
    outline.position.z = HEIGHT / 2 + 0.03;
    const arrow = new BufferGeometry();
    arrow.setAttribute(
      'position',
      new Float32BufferAttribute([0.62, 0, 0.02, 0.4, 0.12, 0.02, 0.4, -0.12, 0.02], 3),
    );
    arrow.setIndex([0, 1, 2]);
    const heading = new Mesh(arrow, this.#heading);
    this.#box = outline;
    this.object.add(outline, heading);
    this.object.visible = false;
  }

  /** Whether it has a box of a usual robot's size: not where the robot's own outline is shown. */
  set boxed(boxed: boolean) {
    this.#box.visible = boxed;
  }

  /** Whether points that are nearer do not hide it. */
  set onTop(onTop: boolean) {
    this.#outline.depthTest = !onTop;
    this.#heading.depthTest = !onTop;
  }
}

const BACKGROUND = 0x0b0f14;
/**
 * The nearest and the farthest that are drawn, m. Chosen: a hand at the eyes, and as far as LiDARs see; a
 * depth buffer of 24 bits still tells 5 cm apart there.
 */
const NEAR_M = 0.05;
const FAR_M = 200;
/**
 * Time constant with which the head follows the robot, ms. Chosen: some three poses of 30 a second; `pnpm
 * bench prediction` has how late that is (without, docs/prediction.md).
 */
const FOLLOW_MS = 90;
/** Eye height while there is no pose, m: a standing person's eyes, looking at the origin. */
const DEFAULT_EYE_M = 1.2;

interface BodyPose {
  position: { x: number; y: number; z: number };
  orientation: { x: number; y: number; z: number; w: number };
}

export class Stage {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  /** The robot's world, REP-103. */
  readonly world = new RobotWorld();
  /** Carries the operator's head; three.js axes. */
  readonly rig = new Group();
  readonly camera = new PerspectiveCamera(DEFAULT_FOV, 1, NEAR_M, FAR_M);
  readonly look = new Look();
  /** Places the operator's head in VR. */
  readonly headset: HeadsetRig;
  /** On the floor before the robot. */
  readonly path = new DrivePath();
  /** What is near the robot, around it. */
  readonly near = new NearRing();
  /** What the robot's own navigator has planned, and its map. */
  readonly plan = new PlannedPathLine();
  readonly floorMap = new FloorMap();
  /** Where operators point. */
  readonly pointers = new PointerRings();
  /** Where the robot is when the picture is shown; `null`: the view follows the clouds. */
  predicted: PredictedView | null = null;
  /** From above, the robot's heading is up; otherwise north. */
  headingUp = true;
  readonly #marker = new RobotMarker();
  readonly #ghost = new RobotGhost();
  /** On the ground that is seen. */
  readonly grid = new GroundGrid();
  /** What the robot looks like. */
  readonly figures: RobotFigures;
  readonly #follower = new PoseFollower(FOLLOW_MS);
  readonly #topDown = new TopDownCamera();
  readonly #vignette = new Vignette();
  readonly #front = new FrontPointer();
  /** Follows the robot's body, in its world. */
  readonly #bodyFollower = new PoseFollower(FOLLOW_MS);
  readonly #fixedSize: { width: number; height: number } | null;
  #lastMs = 0;
  #resolution = 1;

  /** @throws {Error} without WebGL 2 */
  constructor(
    canvas: HTMLCanvasElement,
    fixedSize: { width: number; height: number } | null,
    headset: HeadsetSettings = DEFAULT_HEADSET,
  ) {
    this.#fixedSize = fixedSize;
    this.headset = new HeadsetRig(headset);
    this.renderer = new WebGLRenderer({ canvas, antialias: false, powerPreference: 'high-performance' });
    this.renderer.xr.enabled = true;
    // In VR, the head starts where the headset says that its eyes are at rest.
    this.renderer.xr.setReferenceSpaceType('local');
    this.scene.background = new Color(BACKGROUND);
    this.#marker.object.add(this.near.object, this.path.object);
    this.world.add(this.#marker.object, this.#ghost.object, this.plan.object, this.floorMap.object);
    this.world.add(this.pointers.object);
    this.figures = new RobotFigures(this.#marker.object, this.#ghost.object, this.world);
    this.rig.add(this.camera, this.headset.front);
    this.camera.add(this.#vignette.object, this.#front.object);
    this.scene.add(this.world, this.rig, this.grid.object);
    this.rig.position.set(0, DEFAULT_EYE_M, 0);
    this.camera.rotation.order = 'YXZ';
    this.resize();
  }

  get gl(): WebGL2RenderingContext {
    return this.renderer.getContext() as WebGL2RenderingContext;
  }

  /** What the flat screen shows, or the headset. */
  get viewCamera(): Camera {
    return this.#isFromAbove ? this.#topDown.camera : this.camera;
  }

  /** In VR the world stays as it is. */
  get #isFromAbove(): boolean {
    return this.look.fromAbove && !this.renderer.xr.isPresenting;
  }

  /** Whether the operator looks from the robot's own camera. */
  get #isFromRobot(): boolean {
    if (this.renderer.xr.isPresenting) return this.headset.view.peek() === 'first-person';
    return !this.#isFromAbove && this.look.mode === 'first-person';
  }

  /** Share of the screen's resolution that is drawn, for machines that cannot keep up. */
  set resolution(scale: number) {
    this.#resolution = scale;
    this.resize();
  }

  resize(): void {
    if (this.renderer.xr.isPresenting) return;
    if (this.#fixedSize !== null) {
      this.renderer.setPixelRatio(1);
      this.renderer.setSize(this.#fixedSize.width, this.#fixedSize.height, false);
    } else {
      const { clientWidth, clientHeight } = this.renderer.domElement;
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2) * this.#resolution);
      this.renderer.setSize(Math.max(clientWidth, 1), Math.max(clientHeight, 1), false);
    }
    const { width, height } = this.renderer.domElement;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** Makes the next pose apply at once: it belongs to another robot. */
  forgetPose(): void {
    this.#follower.reset();
    this.#bodyFollower.reset();
    this.headset.align();
    this.look.forgetExtent();
    this.#marker.object.visible = false;
    this.#ghost.hide();
  }

  /** The robot's outline; `null` while it is not known. */
  set robotBody(body: RobotBody | null) {
    this.path.body = body;
    this.#ghost.body = body;
    this.#marker.boxed = body === null && !this.figures.known;
  }

  /** Where a direction of the robot is on the screen, or in the headset's view: radians counter-clockwise from up. */
  onScreen(bearing: number): number {
    return bearingOnScreen(bearing, this.#marker.object, this.viewCamera, this.#isFromAbove);
  }

  /** Sets the pose of the robot's body, from telemetry. */
  setBody(pose: BodyPose): void {
    const { object } = this.#marker;
    object.position.copy(pose.position as typeof object.position);
    object.quaternion.set(pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w);
    object.visible = true;
  }

  /** Places the operator's head and sets the cloud's uniforms for this display frame. */
  prepare(cloud: CloudView, nowMs: number): void {
    const elapsed = nowMs - this.#lastMs;
    this.#lastMs = nowMs;
    const follower = this.#follower;
    const placed = this.predicted?.places ? this.predicted : null;
    if (cloud.hasPoints) {
      this.look.fit(cloud.imageExtent);
      if (placed !== null) {
        const { x, y, z, yaw } = placed.camera;
        follower.place(x, y, z, yaw, elapsed);
      } else {
        const { x, y, z } = cloud.cameraPosition;
        follower.follow(x, y, z, opticalYaw(cloud.cameraOrientation, follower.yaw), elapsed);
      }
    }
    this.#followBody(elapsed, placed);
    this.#showGhost(placed);
    const inVr = this.renderer.xr.isPresenting;
    if (follower.started) {
      if (inVr) this.#placeHeadset(elapsed);
      else this.#placeRig();
      this.grid.centreOn(-follower.y, -follower.x);
    }
    this.pointers.fit(inVr ? this.camera : null, inVr ? this.rig.scale.x : 1);
    this.#vignette.show(inVr ? this.headset.darkness : 0);
    this.#front.show(inVr ? this.headset.frontSide : 0);
    const inTabletop = inVr && this.headset.view.peek() === 'tabletop';
    // The operator's own floor needs no grid.
    this.grid.object.visible = inTabletop || !(inVr && this.headset.passthrough);
    const isSeenFromAbove = inTabletop || this.#isFromAbove;
    this.#marker.onTop = isSeenFromAbove;
    this.path.onTop = isSeenFromAbove;
    this.near.onTop = isSeenFromAbove;
    this.plan.onTop = isSeenFromAbove;
    this.#ghost.onTop = isSeenFromAbove;
    if (this.#isFromAbove) this.#placeTopDown();
    else if (!inVr) this.#placeFlatCamera();
    this.figures.place(this.#isFromRobot, this.viewCamera);
  }

  #followBody(elapsedMs: number, placed: PredictedView | null): void {
    const { visible, position, quaternion } = this.#marker.object;
    const body = this.#bodyFollower;
    if (placed !== null) {
      const { x, y, z, yaw } = placed.body;
      body.place(x, y, z, yaw, elapsedMs);
    } else if (visible) body.follow(position.x, position.y, position.z, bodyYaw(quaternion), elapsedMs);
  }

  #showGhost(placed: PredictedView | null): void {
    const { object } = this.#marker;
    if (placed === null || !placed.isPrediction || !object.visible) {
      this.#ghost.hide();
      return;
    }
    const { x, y, z, yaw } = placed.body;
    const off = Math.hypot(x - object.position.x, y - object.position.y);
    this.#ghost.show(x, y, z, yaw, off, shortestTurn(yaw - bodyYaw(object.quaternion)));
  }

  #placeHeadset(elapsedMs: number): void {
    const { rig, camera, headset } = this;
    const follower = this.#follower;
    const body = this.#bodyFollower;
    const ground = body.started ? body.z : follower.z - DEFAULT_EYE_M;
    headset.place(rig, camera, follower, ground, elapsedMs);
  }

  #placeRig(): void {
    const follower = this.#follower;
    this.rig.position.set(-follower.y, follower.z, -follower.x);
    this.rig.rotation.y = follower.yaw;
    this.rig.scale.setScalar(1);
  }

  #placeTopDown(): void {
    // Without telemetry, the camera is the best guess.
    const body = this.#bodyFollower;
    const { headingUp, look, camera } = this;
    const robot = body.started ? body : this.#follower;
    this.#topDown.place(robot, { headingUp, reach: look.reach, aspect: camera.aspect });
  }

  #placeFlatCamera(): void {
    const { camera, look } = this;
    camera.rotation.set(look.pitch, look.yaw, 0);
    if (look.mode === 'first-person') {
      camera.position.set(0, 0, 0);
    } else {
      // Move back along the line of sight.
      const level = Math.cos(look.pitch) * look.distance;
      camera.position.set(
        Math.sin(look.yaw) * level,
        -Math.sin(look.pitch) * look.distance,
        Math.cos(look.yaw) * level,
      );
    }
    if (camera.fov !== look.fov) {
      camera.fov = look.fov;
      camera.updateProjectionMatrix();
    }
  }
}
