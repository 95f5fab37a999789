/** Entering and leaving VR or AR, and where the headset says that head, hands and floor are. */
import { signal } from '@preact/signals-core';
import type { WebGLRenderer } from 'three';
import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import { vrUnavailable } from '../../words/words.ts';
import { chooseFrameRate, chooseResolution } from '../headset/display-offer.ts';

type DisplaySettings = Pick<HeadsetSettings, 'frameRate' | 'foveation' | 'resolution'>;

export type HeadsetMode = 'immersive-vr' | 'immersive-ar';

export class VrSession {
  /** Whether the headset shows the scene, with or without the operator's own room. */
  readonly active = signal(false);
  /** Whether the operator sees the own room behind the scene. */
  readonly passthrough = signal(false);
  /** Whether a headset can show both. */
  readonly canPassThrough = signal(false);
  /** Why VR is unavailable; `null` if it is available, `undefined` until that is known. */
  readonly unavailable = signal<string | null | undefined>(undefined);
  /** Height of the operator's floor in the tracked space, m; `null` while the headset does not know it. */
  floorY: number | null = null;
  /** Called when the headset is taken off, or covers the picture with a menu of its own. */
  onHidden: (() => void) | null = null;
  /** Called with the head's pose in the tracked space after {@link recentre}. */
  onRecentre: ((head: XRRigidTransform) => void) | null = null;
  /** Called when a session begins, or the headset has moved the tracked space by itself. */
  onReset: (() => void) | null = null;
  readonly #renderer: WebGLRenderer;
  readonly #display: DisplaySettings;
  #floor: XRReferenceSpace | null = null;
  #isRecentring = false;

  /** @param display what is asked of the headset's display, as far as it offers that */
  constructor(renderer: WebGLRenderer, display: DisplaySettings) {
    this.#renderer = renderer;
    this.#display = display;
    renderer.xr.addEventListener('sessionstart', () => this.#begin());
    renderer.xr.addEventListener('sessionend', () => {
      this.#floor = null;
      this.active.value = false;
      this.passthrough.value = false;
    });
    navigator.xr?.addEventListener('devicechange', () => void this.#ask());
    void this.#ask();
  }

  /** Call this from a button's event handler. @throws whatever error the browser gives */
  async toggle(mode: HeadsetMode): Promise<void> {
    const { xr } = this.#renderer;
    if (xr.getSession() !== null) {
      await this.leave();
      return;
    }
    const session = await navigator.xr?.requestSession(mode, {
      optionalFeatures: ['local-floor', 'hand-tracking'],
    });
    if (session === undefined) return;
    const native =
      typeof XRWebGLLayer === 'undefined' ? 1 : XRWebGLLayer.getNativeFramebufferScaleFactor(session);
    xr.setFramebufferScaleFactor(chooseResolution(this.#display.resolution, native));
    xr.setFoveation(this.#display.foveation);
    await xr.setSession(session);
    const rate = chooseFrameRate(session.supportedFrameRates, this.#display.frameRate);
    // Whatever comes of it, the headset goes on at a rate of its own.
    if (rate !== null && rate !== session.frameRate)
      await session.updateTargetFrameRate(rate).catch(() => {});
  }

  /** Ends the session, if there is one. */
  async leave(): Promise<void> {
    await this.#renderer.xr.getSession()?.end();
  }

  /** Refresh rate of the display, Hz; `null` outside a session or where the headset does not say. */
  get frameRate(): number | null {
    return this.#renderer.xr.getSession()?.frameRate ?? null;
  }

  get inputSources(): Iterable<XRInputSource> {
    return this.#renderer.xr.getSession()?.inputSources ?? [];
  }

  /**
   * Whether the headset knows, in this XR frame, where it and this controller are. An emulated position suffices: a
   * headset without positional tracking has no other, and no position of a hand drives.
   */
  tracks({ gripSpace, targetRaySpace }: XRInputSource): boolean {
    const { xr } = this.#renderer;
    const [frame, space] = [xr.getFrame(), xr.getReferenceSpace()];
    if (frame == null || space === null || frame.getViewerPose(space) == null) return false;
    return frame.getPose(gripSpace ?? targetRaySpace, space) != null;
  }

  /** Whether the headset is not worn or its system menu is open. */
  get hidden(): boolean {
    const session = this.#renderer.xr.getSession();
    return session !== null && session.visibilityState !== 'visible';
  }

  /** The head's place in the next display frame becomes the operator's origin. */
  recentre(): void {
    this.#isRecentring = true;
  }

  /** Reads what has been waiting for a display frame. Call this in each one in VR. */
  update(): void {
    if (!this.#isRecentring && (this.#floor === null || this.floorY !== null)) return;
    const { xr } = this.#renderer;
    const frame = xr.getFrame();
    const space = xr.getReferenceSpace();
    if (frame == null || space === null) return;
    if (this.#floor !== null) this.floorY ??= frame.getPose(this.#floor, space)?.transform.position.y ?? null;
    const head = this.#isRecentring ? frame.getViewerPose(space) : undefined;
    if (head == null) return;
    this.#isRecentring = false;
    this.onRecentre?.(head.transform);
  }

  #begin(): void {
    const { xr } = this.#renderer;
    const session = xr.getSession();
    this.#isRecentring = false;
    this.#reset();
    this.passthrough.value = (session?.environmentBlendMode ?? 'opaque') !== 'opaque';
    this.active.value = true;
    session?.addEventListener('visibilitychange', () => {
      if (this.hidden) this.onHidden?.();
    });
    xr.getReferenceSpace()?.addEventListener('reset', () => this.#reset());
    // Some headsets know no floor.
    session?.requestReferenceSpace('local-floor').then(
      (floor) => {
        if (xr.getSession() === session) this.#floor = floor;
      },
      () => {},
    );
  }

  #reset(): void {
    this.floorY = null;
    this.onReset?.();
  }

  async #ask(): Promise<void> {
    const { xr } = navigator;
    const supports = async (mode: HeadsetMode) =>
      (await xr?.isSessionSupported(mode).catch(() => false)) ?? false;
    const supported = await supports('immersive-vr');
    const facts = { secure: isSecureContext, hasWebXr: xr !== undefined, supported };
    this.unavailable.value = vrUnavailable(facts);
    // A phone shows AR, too, but has neither grips nor a STOP in it.
    this.canPassThrough.value = supported && (await supports('immersive-ar'));
  }
}
