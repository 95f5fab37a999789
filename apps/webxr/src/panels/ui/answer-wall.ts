/** A page's end of the wall that it is shown in. */
import { effect } from '@preact/signals-core';
import { type CellState, wallStopSchema } from '../../ground/wall/wall-messages.ts';
import type { PageState } from '../../state/page-state.ts';

/**
 * So often the wall hears from a page in which nothing changes, ms. Chosen: a third of the time after which it is silent
 * (wall.ts).
 */
const TELL_MS = 500;

/** Whether the page is shown in a wall. Only pages of the same server can show it in a frame. */
export function isInWall(): boolean {
  return window.parent !== window;
}

/**
 * Tells the wall how this page is, and does what the wall asks.
 *
 * @param pressStop as if the operator had pressed this page's STOP
 */
export function answerWall(
  { link, robot, driving }: Pick<PageState, 'link' | 'robot' | 'driving'>,
  pressStop: () => void,
): void {
  if (!isInWall()) return;
  let heard = 0;
  const tell = () => {
    const live = link.live.value;
    const cell: CellState = {
      farpoint: 'cell',
      robot: link.chosenRobotId.value,
      name: live ? robot.name.value : null,
      live,
      drives: driving.gripped.value && driving.holder.value === 'you',
      // What was so when the robot was last heard confirms nothing.
      stopped: link.heard.value && robot.latchedStop.value !== null,
      heard,
    };
    window.parent.postMessage(cell, window.location.origin);
  };
  window.addEventListener('message', ({ source, origin, data }) => {
    if (source !== window.parent || origin !== window.location.origin) return;
    const stop = wallStopSchema.safeParse(data);
    if (!stop.success) return;
    heard = stop.data.press;
    if (link.chosenRobotId.peek() !== null) pressStop();
    tell();
  });
  effect(tell);
  setInterval(tell, TELL_MS);
}
