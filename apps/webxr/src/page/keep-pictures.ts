/** Keeps a small picture of what the page shows of each robot, for the list of robots. */
import type { RobotClient } from '@farpoint/operator';
import { LAST_PICTURE, type LastPictures } from '../ground/pictures/last-pictures.ts';
import type { Stage } from '../scene/view/stage.ts';
import type { FrameLoop } from './frame-loop.ts';

/**
 * How often a picture is kept, ms. Chosen: an age is said in minutes; reading a picture back takes some milliseconds of the page's
 * thread. fleet.page.ts holds it.
 */
const PICTURE_MS = 10_000;
/** Chosen: a picture of {@link LAST_PICTURE} takes some 8 kB then. */
const JPEG_QUALITY = 0.7;

export interface KeptPicturesParts {
  readonly client: Pick<RobotClient, 'phase' | 'chosenRobotId' | 'pointsAtMs'>;
  readonly stage: Pick<Stage, 'renderer'>;
  readonly frames: Pick<FrameLoop, 'afterNextFrame'>;
  readonly pictures: Pick<LastPictures, 'keep'>;
}

export function keepPictures({ client, stage: { renderer }, frames, pictures }: KeptPicturesParts): void {
  const canvas = Object.assign(document.createElement('canvas'), LAST_PICTURE);
  const context = canvas.getContext('2d');
  let keptMs = 0;
  setInterval(() => {
    // In a headset, the canvas shows nothing.
    if (client.phase !== 'live' || document.hidden || renderer.xr.isPresenting) return;
    // What has not changed is older than it would be said to be.
    if (client.pointsAtMs <= keptMs) return;
    keptMs = performance.now();
    frames.afterNextFrame(() => {
      const id = client.chosenRobotId;
      if (id === null || client.phase !== 'live' || context === null) return;
      drawMiddle(context, renderer.domElement);
      pictures.keep(id, canvas.toDataURL('image/jpeg', JPEG_QUALITY), Date.now());
    });
  }, PICTURE_MS);
}

/** Fills the small picture with the middle of a picture of another shape. */
function drawMiddle(context: CanvasRenderingContext2D, from: HTMLCanvasElement): void {
  const { width, height } = LAST_PICTURE;
  const scale = Math.max(width / from.width, height / from.height);
  const [wide, high] = [from.width * scale, from.height * scale];
  context.drawImage(from, (width - wide) / 2, (height - high) / 2, wide, high);
}
