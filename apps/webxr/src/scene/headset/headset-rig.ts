/** Places what carries the operator's head in the robot's world, by view, recentring and turning. Allocates nothing. */

import { shortestTurn } from '@farpoint/protocol';
import { type Signal, signal } from '@preact/signals-core';
import { Group, type Object3D } from 'three';
import type { HeadsetSettings, HeadsetView } from '../../ground/headset-settings.ts';
import { headYaw, OperatorOrigin } from './operator-origin.ts';
import { OperatorTurn } from './operator-turn.ts';
import { TableModel } from './table-model.ts';
import { VignetteAmount } from './vignette-amount.ts';

/**
 * Over the shoulder: behind the robot's camera and above it, m (docs/headset.md). Chosen by eye: the robot
 * and the floor before it are in view.
 */
export const BEHIND_M = 2.4;
const ABOVE_M = 0.6;

/** A place in the robot's world, REP-103, m. */
export interface WorldPlace {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** A model of the world in the operator's room: axes of three.js, m from the operator's origin. */
export interface ModelPlace {
  /** Where the robot's place on the floor is in the room. */
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Metres in the room of one metre of the world. */
  readonly scale: number;
}

/**
 * Where the operator's origin is in the robot's world, by view: the eyes at rest, which a recentring makes the origin. Pure,
 * allocates nothing.
 */
class RigPose {
  /** Place of the operator's origin, three.js axes, m. */
  x = 0;
  y = 0;
  z = 0;
  /** Radians about the vertical, positive to the left. */
  yaw = 0;
  /** Metres of the world that one metre of the room is. */
  scale = 1;

  /**
   * At the robot's camera, at true scale.
   *
   * @param eyeHeight height of the origin in the world, m
   */
  firstPerson(camera: WorldPlace, eyeHeight: number, yaw: number): void {
    this.x = -camera.y;
    this.y = eyeHeight;
    this.z = -camera.x;
    this.yaw = yaw;
    this.scale = 1;
  }

  /** Behind the robot, as the operator faces, and above it. */
  overShoulder(camera: WorldPlace, eyeHeight: number, yaw: number): void {
    this.firstPerson(camera, eyeHeight, yaw);
    this.x += Math.sin(yaw) * BEHIND_M;
    this.z += Math.cos(yaw) * BEHIND_M;
  }

  /**
   * The world is a model in the operator's room.
   *
   * @param x the robot's place in its world, REP-103, m
   * @param y likewise
   * @param ground height of its floor, m
   * @param yaw where ahead in the room points in the world
   */
  tabletop(x: number, y: number, ground: number, model: ModelPlace, yaw: number): void {
    const k = 1 / model.scale;
    const cos = Math.cos(yaw);
    const sin = Math.sin(yaw);
    this.x = -y - k * (model.x * cos + model.z * sin);
    this.y = ground - k * model.y;
    this.z = -x - k * (model.z * cos - model.x * sin);
    this.yaw = yaw;
    this.scale = k;
  }
}

/**
 * Where the operator's "ahead" points in the world: fixed, so that a robot that turns does not turn the operator's room
 * about them, or with the robot. Pure, allocates nothing. Angles in radians, counter-clockwise seen from above; places in
 * three.js axes (x right, y up, z back).
 */
class ViewHeading {
  /** Where ahead points now. */
  yaw = 0;
  /** How far turns about the head have moved the operator's origin, m. */
  shiftX = 0;
  shiftZ = 0;
  /** Whether ahead turns with the robot, from where it is. */
  followsRobot = false;
  #base: number | null = null;
  #own = 0;

  /** The robot's next heading becomes the operator's. */
  align(): void {
    this.#base = null;
    this.#own = 0;
    this.shiftX = 0;
    this.shiftZ = 0;
  }

  /** @param robotYaw the robot's heading */
  follow(robotYaw: number): void {
    if (this.followsRobot || this.#base === null) this.#base = robotYaw;
    this.yaw = this.#base + this.#own;
  }

  /** @param by positive to the left */
  turn(by: number): void {
    this.#own += by;
    this.yaw += by;
  }

  /**
   * Turns about the operator's head, which stays where it is: someone who leans or stands beside the origin does not swing
   * around it.
   *
   * @param x place of the head relative to the operator's origin, m
   * @param z likewise
   */
  turnAbout(by: number, x: number, z: number): void {
    const cos = Math.cos(this.yaw);
    const sin = Math.sin(this.yaw);
    this.turn(by);
    const cosAfter = Math.cos(this.yaw);
    const sinAfter = Math.sin(this.yaw);
    this.shiftX += x * (cos - cosAfter) + z * (sin - sinAfter);
    this.shiftZ += x * (sinAfter - sin) + z * (cos - cosAfter);
  }
}

/** The robot's place and heading as the view follows them. */
export interface FollowedRobot extends WorldPlace {
  readonly yaw: number;
}

export class HeadsetRig {
  readonly view: Signal<HeadsetView> = signal('first-person');
  /** Where the operator's eyes are at rest, in the tracked space. */
  readonly origin = new OperatorOrigin();
  /** The world on the table. */
  readonly model = new TableModel();
  /** Carries what hangs before the eyes at rest; a child of the rig. */
  readonly front = new Group();
  /** Deflection to the right of the stick that turns the view, −1…1. */
  turnStick = 0;
  /** Height of the operator's floor in the tracked space, m; `null` while it is not known. */
  floorY: number | null = null;
  /** Whether the operator sees the own room: then nothing moves them, and nothing needs to be dark. */
  passthrough = false;
  /** To which side the robot's front is, in first person: −1 left, 1 right, 0 in view. */
  frontSide: -1 | 0 | 1 = 0;
  readonly #pose = new RigPose();
  readonly #heading = new ViewHeading();
  readonly #turn: OperatorTurn;
  readonly #amount: VignetteAmount;
  readonly #settings: HeadsetSettings;
  /** Whether the view is where it was in the last frame, but for motion: not after a jump. */
  #moves = false;

  /** @param settings are read in each frame */
  constructor(settings: HeadsetSettings) {
    this.#settings = settings;
    this.#turn = new OperatorTurn(settings);
    this.#amount = new VignetteAmount(settings);
  }

  /** Where ahead in the room points in the world, radians. */
  get yaw(): number {
    return this.#pose.yaw;
  }

  /** How dark the edge of the view is, 0 … 1. */
  get darkness(): number {
    return this.#amount.value;
  }

  /** A session begins, or the headset has recentred by itself: the eyes at rest are where it says. */
  begin(): void {
    this.origin.reset();
    this.model.reset();
    this.align();
  }

  /** The robot's heading becomes ahead. */
  align(): void {
    this.#heading.align();
    this.#turn.disarm();
    this.#amount.clear();
    this.#moves = false;
  }

  /** Changes the view. What hands hold of the model, they let go. */
  show(view: HeadsetView): void {
    this.view.value = view;
    this.model.letGo();
    this.#moves = false;
  }

  /**
   * The head's place becomes the eyes' place at rest, and the model returns to its first place.
   *
   * @param orientation of the head in the tracked space
   */
  recentre(position: DOMPointReadOnly, orientation: DOMPointReadOnly): void {
    this.origin.recentre(position, orientation);
    this.model.reset();
    this.align();
  }

  /**
   * Call this before each display frame in VR.
   *
   * @param rig carries the tracked space
   * @param head the operator's head, a child of the rig
   * @param camera the robot's camera
   * @param ground height of the robot's floor in its world, m
   */
  place(rig: Group, head: Object3D, camera: FollowedRobot, ground: number, elapsedMs: number): void {
    const pose = this.#pose;
    const { x, y, z, yaw } = pose;
    const by = this.#turn.by(this.turnStick, elapsedMs);
    this.#heading.followsRobot = this.#settings.turn === 'robot';
    this.#heading.follow(camera.yaw);
    this.#turnView(by, head);
    this.#setPose(camera, ground);
    this.#apply(rig);
    const isInside = this.view.peek() === 'first-person';
    this.frontSide = isInside ? frontSide(camera.yaw, rig.rotation.y + headYaw(head.quaternion)) : 0;
    const seconds = elapsedMs / 1000;
    const moves = this.#moves && !this.passthrough && this.view.peek() !== 'tabletop' && seconds > 0;
    this.#moves = true;
    const { turn } = this.#settings;
    // A step is over before anybody could become sick of it.
    const turnRate = moves && turn !== 'snap' ? (pose.yaw - yaw) / seconds : 0;
    const isMoved = moves && turn === 'robot';
    const speed = isMoved ? Math.hypot(pose.x - x, pose.y - y, pose.z - z) / seconds : 0;
    this.#amount.update(turnRate, speed, elapsedMs);
  }

  #turnView(by: number, { position: head }: Object3D): void {
    const heading = this.#heading;
    const view = this.view.peek();
    if (view === 'tabletop') heading.turn(by - this.model.turned);
    else if (by === 0) return;
    else if (view === 'over-shoulder') heading.turn(by);
    else heading.turnAbout(by, this.origin.rightOf(head.x, head.z), this.origin.behind(head.x, head.z));
  }

  #setPose(camera: FollowedRobot, ground: number): void {
    const { yaw, shiftX, shiftZ } = this.#heading;
    const pose = this.#pose;
    switch (this.view.peek()) {
      case 'first-person':
        pose.firstPerson(camera, this.#eyeHeight(ground) ?? camera.z, yaw);
        pose.x += shiftX;
        pose.z += shiftZ;
        return;
      case 'over-shoulder':
        pose.overShoulder(camera, this.#eyeHeight(ground) ?? camera.z + ABOVE_M, yaw);
        return;
      case 'tabletop':
        pose.tabletop(camera.x, camera.y, ground, this.model, yaw);
    }
  }

  /** Height of a standing operator's eyes at rest in the robot's world, m; `null` for a seated one. */
  #eyeHeight(ground: number): number | null {
    const { floorY } = this;
    if (this.#settings.posture === 'seated' || floorY === null) return null;
    return ground - this.origin.above(floorY);
  }

  /** The tracked space's own origin is elsewhere than the operator's. */
  #apply(rig: Group): void {
    const pose = this.#pose;
    const { origin } = this;
    const yaw = pose.yaw - origin.yaw;
    const cos = Math.cos(yaw);
    const sin = Math.sin(yaw);
    rig.position.set(
      pose.x - pose.scale * (origin.x * cos + origin.z * sin),
      pose.y - pose.scale * origin.y,
      pose.z - pose.scale * (origin.z * cos - origin.x * sin),
    );
    rig.rotation.y = yaw;
    rig.scale.setScalar(pose.scale);
    this.front.position.set(origin.x, origin.y, origin.z);
    this.front.rotation.y = origin.yaw;
  }
}

/**
 * A front within this angle of where the face points is in view, radians: a headset shows some 45° to each
 * side.
 */
const IN_VIEW = (40 * Math.PI) / 180;

/**
 * @param front the robot's heading, radians, positive to the left
 * @param face where the operator's face points, likewise
 * @returns −1: to the left, 1: to the right, 0: in view
 */
export function frontSide(front: number, face: number): -1 | 0 | 1 {
  const away = shortestTurn(front - face);
  if (!(Math.abs(away) > IN_VIEW)) return 0;
  return away > 0 ? -1 : 1;
}
