/** What a camera's panel says about it. */
import { type CameraView, STALE_MS } from '../ground/pictures/camera-view.ts';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';

/**
 * `off`: switched off by the operator. `fault`: the robot or this browser says what is wrong. `waiting`: no picture has
 * come yet. `frozen`: the last picture is old. `live`: it is not.
 */
export type CameraState = 'off' | 'fault' | 'waiting' | 'frozen' | 'live';

export interface CameraWords {
  readonly state: CameraState;
  /** A few words or an age. */
  readonly text: string;
  /** Why there are no pictures; `null` if that is not known. */
  readonly reason: string | null;
}

/** Read it within an effect or not: it does not read the newest picture's signal, which changes with each frame. */
export function cameraWords({
  camera,
  ageMs,
  fault,
}: Pick<CameraView, 'camera' | 'ageMs' | 'fault'>): CameraWords {
  const age = ageMs.peek();
  const reason = fault.value;
  const said = texts().media.camera;
  if (!camera.on.value) return { state: 'off', text: said.hidden, reason: null };
  if (reason !== null)
    return { state: 'fault', text: age === null ? said.noPicture : said.fault(seconds(age)), reason };
  if (age === null) return { state: 'waiting', text: said.waiting, reason: null };
  if (age > STALE_MS) return { state: 'frozen', text: said.frozen(seconds(age)), reason: null };
  return { state: 'live', text: `${Math.round(age / 10) * 10} ms`, reason: null };
}

function seconds(ms: number): string {
  return `${fixed(ms / 1000, 1)} s`;
}
