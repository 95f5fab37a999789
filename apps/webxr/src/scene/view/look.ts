/** Where the operator looks on a flat screen: along the robot's heading, or from behind the robot. */
export type ViewMode = 'first-person' | 'third-person';

/**
 * Fields of view, degrees: the bounds of zooming, and the usual one. Chosen by eye: below, a screen shows a
 * detail; above, its edges are stretched.
 */
export const MIN_FOV = 30;
export const MAX_FOV = 100;
export const DEFAULT_FOV = 75;
/** The picture of a narrow camera fills the screen with this margin. A wide one need not be entirely visible. */
const FIT_MARGIN = 1.15;
const LEAST_FIT_FOV = 35;
/** The view is not changed while it fits to within this, degrees. */
const FIT_TOLERANCE = 5;
/**
 * How far the view from above reaches to the nearest edge of the screen, metres. Chosen: a room, a detail,
 * and as far as docs/page.md says.
 */
export const DEFAULT_REACH = 6;
export const MIN_REACH = 1;
export const MAX_REACH = 60;
/**
 * How far behind the robot the third-person view is, metres. Chosen by eye: about as over the shoulder in the
 * headset (headset-rig.ts).
 */
export const DEFAULT_DISTANCE = 2.5;
const MAX_DISTANCE = 15;
/**
 * Clouds that reach farther than this multiple of the usual reach are fitted, until they reach less far than the second.
 * Small ones are on the screen as it is; and how far a camera sees that looks at a wall says nothing of the scene.
 */
const FITTED = { begins: 2.5, ends: 2 };
/** What is fitted has this margin, and stays while it is right within this factor. */
const EXTENT_MARGIN = 1.05;
const EXTENT_TOLERANCE = 1.3;
const MAX_PITCH = (Math.PI / 180) * 85;

export class Look {
  mode: ViewMode = 'first-person';
  /** From straight above instead, whatever the mode. */
  fromAbove = false;
  /** Metres from the robot to the nearest edge of the screen, from above. */
  reach = DEFAULT_REACH;
  /** Radians; positive to the left. */
  yaw = 0;
  /** Radians; positive upwards. */
  pitch = 0;
  /** Vertical field of view, degrees. */
  fov = DEFAULT_FOV;
  /** Distance behind the robot, metres. */
  distance = DEFAULT_DISTANCE;
  #fitted = DEFAULT_FOV;
  #zoomed = false;
  /** The reach that fits the cloud's extent, and whether it is known. */
  #fittedReach = DEFAULT_REACH;
  #extentKnown = false;
  /** What the operator has zoomed himself. */
  #zoomedAbove = false;
  #zoomedBehind = false;

  /** A drag over the screen. @param radiansPerPixel chosen so that the point under the cursor stays under it */
  drag(dx: number, dy: number, radiansPerPixel: number): void {
    // From above, the robot stays in the middle.
    if (this.fromAbove) return;
    this.yaw += dx * radiansPerPixel;
    this.pitch = clamp(this.pitch + dy * radiansPerPixel, -MAX_PITCH, MAX_PITCH);
  }

  /**
   * Fits the first-person view to the camera, until the operator zooms.
   *
   * @param imageExtent size of the camera's picture at a distance of 1 m, metres
   */
  fit(imageExtent: number): void {
    const camera = (2 * Math.atan(imageExtent / 2) * 180) / Math.PI;
    const fov = clamp(camera * FIT_MARGIN, LEAST_FIT_FOV, DEFAULT_FOV);
    if (Math.abs(fov - this.#fitted) >= FIT_TOLERANCE) this.#fitted = fov;
    if (!this.#zoomed && this.mode === 'first-person') this.fov = this.#fitted;
  }

  /**
   * Fits the view from above to the cloud's extent, and moves the third-person view back, until the operator zooms. A view
   * that is looked at is fitted only when the extent becomes known: it does not zoom by itself under somebody who drives.
   *
   * @param extent how far most of the cloud reaches, metres; `null`: not known
   */
  fitExtent(extent: number | null): void {
    if (extent === null) return;
    const fitted = this.#reachFor(extent);
    const ratio = fitted / this.#fittedReach;
    const isFirst = !this.#extentKnown;
    this.#extentKnown = true;
    if (Math.max(ratio, 1 / ratio) >= EXTENT_TOLERANCE || fitted === DEFAULT_REACH)
      this.#fittedReach = fitted;
    const isBehind = !this.fromAbove && this.mode === 'third-person';
    if (!this.#zoomedAbove && (isFirst || !this.fromAbove)) this.reach = this.#fittedReach;
    if (!this.#zoomedBehind && (isFirst || !isBehind)) this.distance = this.#fittedDistance;
  }

  /** Another robot's cloud has another extent. */
  forgetExtent(): void {
    this.#extentKnown = false;
    this.#fittedReach = DEFAULT_REACH;
  }

  /** @param factor above 1: further away */
  zoom(factor: number): void {
    if (this.fromAbove) {
      this.#zoomedAbove = true;
      this.reach = clamp(this.reach * factor, MIN_REACH, MAX_REACH);
    } else if (this.mode === 'first-person') {
      this.fov = clamp(this.fov * factor, MIN_FOV, MAX_FOV);
      this.#zoomed = true;
    } else {
      this.distance = clamp(this.distance * factor, 0.8, MAX_DISTANCE);
      this.#zoomedBehind = true;
    }
  }

  recentre(): void {
    if (this.fromAbove) {
      this.reach = this.#fittedReach;
      this.#zoomedAbove = false;
      return;
    }
    this.yaw = 0;
    this.pitch = this.mode === 'first-person' ? 0 : -0.35;
    this.fov = this.mode === 'first-person' ? this.#fitted : DEFAULT_FOV;
    this.#zoomed = false;
    this.distance = this.#fittedDistance;
    this.#zoomedBehind = false;
  }

  switchMode(): void {
    this.mode = this.mode === 'first-person' ? 'third-person' : 'first-person';
    this.recentre();
  }

  /** The robot stays recognisable: it is moved away from by the square root of the reach. */
  get #fittedDistance(): number {
    return DEFAULT_DISTANCE * Math.sqrt(this.#fittedReach / DEFAULT_REACH);
  }

  #reachFor(extent: number): number {
    const before = this.#fittedReach;
    const most = DEFAULT_REACH * (before > DEFAULT_REACH ? FITTED.ends : FITTED.begins);
    return extent <= most ? DEFAULT_REACH : Math.min(extent * EXTENT_MARGIN, MAX_REACH);
  }
}

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
