/** Lays the grid on the ground that is seen, and fits the views from outside to how far the clouds reach. */
import type { CloudView } from '@farpoint/cloud-view';
import type { Stage } from './stage.ts';

/** Call it a few times a second. @param clouds of all sensors; those that are switched off know nothing of the scene */
export function followScene(
  { look, grid }: Pick<Stage, 'look' | 'grid'>,
  clouds: readonly Pick<CloudView, 'colouring'>[],
): void {
  let extent: number | null = null;
  // Where nobody sees another ground, it is that of the robot's base.
  let ground = clouds[0]?.colouring.ground ?? 0;
  for (const { colouring } of clouds) {
    const { scene } = colouring;
    if (scene.extent === null || scene.extent <= (extent ?? 0)) continue;
    // The sensor that sees farthest sees most of the ground.
    extent = scene.extent;
    ground = scene.ground ?? colouring.ground;
  }
  look.fitExtent(extent);
  grid.approach(ground);
}
