/**
 * Draws everything once, also what is hidden. A material that is drawn for the first time makes the page wait for the graphics
 * processor, for a tenth of a second and more without a GPU: that must not be in the middle of a drive.
 */
import type { Camera, Object3D, Scene, WebGLRenderer } from 'three';

/** Call it while nobody drives, just before a picture is drawn, which then replaces this one. */
export function warmUp(renderer: Pick<WebGLRenderer, 'render'>, scene: Scene, camera: Camera): void {
  const hidden: Object3D[] = [];
  const culled: Object3D[] = [];
  scene.traverse((object) => {
    if (!object.visible) hidden.push(object);
    if (object.frustumCulled) culled.push(object);
    object.visible = true;
    object.frustumCulled = false;
  });
  try {
    renderer.render(scene, camera);
  } finally {
    for (const object of hidden) object.visible = false;
    for (const object of culled) object.frustumCulled = true;
  }
}
