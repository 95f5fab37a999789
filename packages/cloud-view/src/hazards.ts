/** Which places of a cloud a robot would hit, and where it would fall: by their heights above its base. */
import type { Vector3 as Position, Quaternion } from '@farpoint/operator';
import { Vector3, Vector4 } from 'three';
import type { Rgb } from './colour-map.ts';

/** What is tinted, in metres. Heights are those above the x-y plane of base_link. */
export interface Hazards {
  /** Of base_link in the robot's world. */
  readonly position: Position;
  /** Of base_link in the robot's world, a unit quaternion. */
  readonly orientation: Quaternion;
  /** What is lower is floor. */
  readonly clearanceM: number;
  /** What is higher is passed under. */
  readonly heightM: number;
  /** What lies lower than this below the plane is a missing floor. */
  readonly dropM: number;
  /** By how much the clearance and the drop grow with each metre of distance. */
  readonly slope: number;
  /** What is nearer to the z axis of base_link is the robot itself. */
  readonly ownM: number;
}

/** What the robot would hit is mixed with this colour: red, green and blue, 0–1. */
export const HIT_TINT: Rgb = [1, 0.27, 0.2];
/** Where the floor is missing, with this one. */
export const DROP_TINT: Rgb = [0.71, 0.48, 1];
/** Share of a tint's colour: what is tinted can still be recognised. Chosen by eye. */
export const TINT_SHARE = 0.6;
/** Up to this distance from base_link, tints are whole, metres. */
export const TINTED_M = 4;
/**
 * Here they end: farther away, a base that is tilted by a degree would tint the floor: 14 cm at 8 m
 * (docs/awareness.md).
 */
export const LAST_TINTED_M = 8;

export interface HazardUniforms {
  /** Position of base_link in the world; w: what is nearer is the robot itself, metres. */
  hazardBase: { value: Vector4 };
  /** The z axis of base_link in the world. */
  hazardUp: { value: Vector3 };
  /** Clearance, height, drop (metres) and slope. A height of 0: nothing is tinted. */
  hazardBand: { value: Vector4 };
}

export function hazardUniforms(): HazardUniforms {
  return {
    hazardBase: { value: new Vector4() },
    hazardUp: { value: new Vector3(0, 0, 1) },
    hazardBand: { value: new Vector4() },
  };
}

/** Sets what is tinted; `null`: nothing. Allocates nothing. */
export function setHazards(uniforms: HazardUniforms, hazards: Hazards | null): void {
  const { hazardBase, hazardUp, hazardBand } = uniforms;
  if (hazards === null) {
    hazardBand.value.set(0, 0, 0, 0);
    return;
  }
  const { position, clearanceM, heightM, dropM, slope, ownM } = hazards;
  const { x, y, z, w } = hazards.orientation;
  hazardBase.value.set(position.x, position.y, position.z, ownM);
  hazardUp.value.set(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
  hazardBand.value.set(clearanceM, heightM, dropM, slope);
}
