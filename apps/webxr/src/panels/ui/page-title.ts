/** The page's heading, which is only heard, and the title of its tab: both name the robot. */
import { effect } from '@preact/signals-core';
import type { LinkState } from '../../state/link-state.ts';
import { elements } from './elements.ts';

const PRODUCT = 'Farpoint';

/** Names the chosen robot from now on. */
export function showTitle({ robots, chosenRobotId }: Pick<LinkState, 'robots' | 'chosenRobotId'>): void {
  effect(() => {
    const id = chosenRobotId.value;
    // A robot that is away is not listed.
    const name = id === null ? null : (robots.value.find((robot) => robot.id === id)?.name ?? id);
    elements.pageTitle.textContent = name ?? PRODUCT;
    document.title = name === null ? PRODUCT : `${name} – ${PRODUCT}`;
  });
}
