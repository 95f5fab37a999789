/** The page's address names the chosen robot, so that a reload, a bookmark or another tab comes back to it. */
import { effect } from '@preact/signals-core';
import type { LinkState } from '../state/link-state.ts';

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
