import type { WebGLRenderer } from 'three';

/** Names of renderers that draw on the processor (WEBGL_debug_renderer_info): ANGLE's, Mesa's, Windows'. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether WebGL draws on the processor, as far as the browser says. Surfaces take it several times as long as points. */
export function isSoftwareRenderer(gl: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = gl.getParameter(info === null ? gl.RENDERER : info.UNMASKED_RENDERER_WEBGL);
  return typeof name === 'string' && SOFTWARE.test(name);
}

/** Height of one eye's picture, pixels of the drawing buffer. */
export function viewportHeightOf({ xr, domElement }: WebGLRenderer): number {
  if (!xr.isPresenting) return domElement.height;
  return xr.getCamera().cameras[0]?.viewport?.w ?? domElement.height;
}
