/** Which robots there are, and which is chosen: the list, the switcher in the bar, and the page's address. */
import type { RobotClient } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { LinkState } from '../state/link-state.ts';
import type { FrameLoop } from '../view/frame-loop.ts';
import { LAST_PICTURE, LastPictures } from '../view/last-pictures.ts';
import type { Stage } from '../view/stage.ts';
import { keepRobotInAddress } from './robot-in-address.ts';
import { showRobotList } from './robot-list.ts';
import { showRobotSwitcher } from './robot-switcher.ts';

/** How often a picture is kept, ms. */
const PICTURE_MS = 5000;

export interface RobotsParts {
  readonly client: Pick<RobotClient, 'link'>;
  readonly stage: Pick<Stage, 'renderer'>;
  readonly frames: Pick<FrameLoop, 'afterNextFrame'>;
}

export function showRobots(
  link: LinkState,
  { client, stage, frames }: RobotsParts,
  onChoose: (robotId: string) => void,
): void {
  const { statusFeed } = client.link;
  // Only the list shows what robots say, and it is shown without a robot.
  effect(() => statusFeed.watchStatuses(!link.connected.value));
  const pictures = keepPictures(link, stage, frames);
  showRobotList(link, pictures, onChoose);
  showRobotSwitcher(link, onChoose);
  keepRobotInAddress(link);
}

function keepPictures(
  { live, chosenRobotId }: LinkState,
  { renderer }: RobotsParts['stage'],
  frames: RobotsParts['frames'],
) {
  const pictures = new LastPictures<HTMLCanvasElement>();
  const draw = (earlier: HTMLCanvasElement | null) => {
    const { width, height } = LAST_PICTURE;
    const picture = earlier ?? Object.assign(document.createElement('canvas'), LAST_PICTURE);
    const { domElement } = renderer;
    // The middle of a picture of another shape.
    const scale = Math.max(width / domElement.width, height / domElement.height);
    const [wide, high] = [domElement.width * scale, domElement.height * scale];
    picture.getContext('2d')?.drawImage(domElement, (width - wide) / 2, (height - high) / 2, wide, high);
    return picture;
  };
  setInterval(() => {
    // In a headset, the canvas shows nothing.
    if (!live.peek() || document.hidden || renderer.xr.isPresenting) return;
    frames.afterNextFrame(() => {
      const id = chosenRobotId.peek();
      if (id !== null && live.peek()) pictures.keep(id, draw, performance.now());
    });
  }, PICTURE_MS);
  return pictures;
}
