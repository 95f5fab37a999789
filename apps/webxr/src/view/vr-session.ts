/** Entering and leaving VR. */
import type { WebGLRenderer } from 'three';
import { vrUnavailable } from '../status/words.ts';

export class VrSession {
  readonly #renderer: WebGLRenderer;
  readonly #onChange: (active: boolean) => void;

  constructor(renderer: WebGLRenderer, onChange: (active: boolean) => void) {
    this.#renderer = renderer;
    this.#onChange = onChange;
    renderer.xr.addEventListener('sessionstart', () => onChange(true));
    renderer.xr.addEventListener('sessionend', () => onChange(false));
  }

  /** Why VR cannot be entered here, or `null`. */
  async unavailable(): Promise<string | null> {
    const { xr } = navigator;
    const supported = (await xr?.isSessionSupported('immersive-vr').catch(() => false)) ?? false;
    return vrUnavailable({ secure: isSecureContext, hasWebXr: xr !== undefined, supported });
  }

  /** Must be called from a press of a button. @throws what the browser says */
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
    this.#onChange(true);
  }

  get active(): boolean {
    return this.#renderer.xr.isPresenting;
  }

  get inputSources(): Iterable<XRInputSource> {
    return this.#renderer.xr.getSession()?.inputSources ?? [];
  }

  /** The headset is not worn, or its system menu is open. */
  get hidden(): boolean {
    const session = this.#renderer.xr.getSession();
    return session !== null && session.visibilityState !== 'visible';
  }
}
