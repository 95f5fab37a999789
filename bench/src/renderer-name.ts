/** What a browser draws with. */
import type { Page } from '@playwright/test';

/** As WebGL names it, e.g. `ANGLE (NVIDIA, …)`; `none` without WebGL. */
export function rendererName(page: Page): Promise<string> {
  return page.evaluate(() => {
    const gl = document.createElement('canvas').getContext('webgl2');
    const info = gl?.getExtension('WEBGL_debug_renderer_info');
    if (!gl || !info) return 'none';
    const name = String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
    gl.getExtension('WEBGL_lose_context')?.loseContext();
    return name;
  });
}
