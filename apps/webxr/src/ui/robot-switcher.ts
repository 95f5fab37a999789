/** The bar's list of robots: the one that is connected to, and in one action another. */
import { effect } from '@preact/signals-core';
import type { LinkState } from '../state/link-state.ts';
import { elements } from './elements.ts';

export function showRobotSwitcher(link: LinkState, onChoose: (robotId: string) => void): void {
  const { robotSwitch } = elements;
  robotSwitch.addEventListener('change', () => {
    onChoose(robotSwitch.value);
    // The arrow keys drive again.
    robotSwitch.blur();
  });
  // Only when something has changed: a list that is built anew closes under the hand that holds it open.
  effect(() => {
    const robots = link.robots.value;
    const robotId = link.chosenRobotId.value;
    robotSwitch.hidden = robotId === null || !robots.some(({ id }) => id !== robotId);
    if (robotId === null) return;
    const away = robots.some(({ id }) => id === robotId) ? [] : [{ id: robotId, name: `${robotId} (away)` }];
    robotSwitch.replaceChildren(
      ...[...away, ...robots].map(({ id, name }) => new Option(name, id, false, id === robotId)),
    );
  });
}
