/** Entering and leaving VR. */
import { signal } from '@preact/signals-core';
import type { WebGLRenderer } from 'three';
import { vrUnavailable } from '../status/words.ts';

export class VrSession {
  readonly active = signal(false);
  /** Why VR is unavailable; `null` if it is available, `undefined` until that is known. */
  readonly unavailable = signal<string | null | undefined>(undefined);
  /** Called when the headset is taken off, or covers the picture with a menu of its own. */
  onHidden: (() => void) | null = null;
  readonly #renderer: WebGLRenderer;

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
    renderer.xr.addEventListener('sessionstart', () => {
      this.active.value = true;
      renderer.xr.getSession()?.addEventListener('visibilitychange', () => {
        if (this.hidden) this.onHidden?.();
      });
    });
    renderer.xr.addEventListener('sessionend', () => {
      this.active.value = false;
    });
    navigator.xr?.addEventListener('devicechange', () => void this.#ask());
    void this.#ask();
  }

  /** Call this from a button's event handler. @throws whatever error the browser gives */
  async toggle(): Promise<void> {
    const { xr } = this.#renderer;
    const running = xr.getSession();
    if (running !== null) {
      await running.end();
      return;
    }
    const session = await navigator.xr?.requestSession('immersive-vr', { optionalFeatures: ['local-floor'] });
    if (session === undefined) return;
    await xr.setSession(session);
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

  async #ask(): Promise<void> {
    const { xr } = navigator;
    const supported = (await xr?.isSessionSupported('immersive-vr').catch(() => false)) ?? false;
    const facts = { secure: isSecureContext, hasWebXr: xr !== undefined, supported };
    this.unavailable.value = vrUnavailable(facts);
  }
}
