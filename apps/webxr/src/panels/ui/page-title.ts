/** The page's heading, which is only heard, the title of its tab, and its address: all name the robot. */
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

/** Keeps the chosen robot in the page's address, so that a reload, a bookmark or another tab comes back to it. */
export function keepRobotInAddress({ chosenRobotId }: Pick<LinkState, 'chosenRobotId'>): void {
  effect(() => {
    const id = chosenRobotId.value;
    const address = new URL(window.location.href);
    if (address.searchParams.get('robot') === id) return;
    if (id === null) address.searchParams.delete('robot');
    else address.searchParams.set('robot', id);
    window.history.replaceState(window.history.state, '', address);
  });
}
