/** The list of robots in the bar. */
import { effect } from '@preact/signals-core';
import type { LinkState } from '../../state/link-state.ts';
import { texts } from '../../words/language.ts';
import { elements } from './elements.ts';

/** Shows the chosen robot, and switches to another one in a single action. */
export function showRobotSwitcher(link: LinkState, onChoose: (robotId: string) => void): void {
  const { robotSwitch } = elements;
  robotSwitch.addEventListener('change', () => {
    onChoose(robotSwitch.value);
    // Gives the arrow keys back to driving.
    robotSwitch.blur();
  });
  // Rebuild the list only when something has changed: rebuilding closes it while the operator has it open.
  effect(() => {
    const robots = link.robots.value;
    const robotId = link.chosenRobotId.value;
    robotSwitch.hidden = robotId === null || !robots.some(({ id }) => id !== robotId);
    if (robotId === null) return;
    const away = robots.some(({ id }) => id === robotId)
      ? []
      : [{ id: robotId, name: texts().link.offlineRobot(robotId) }];
    robotSwitch.replaceChildren(
      ...[...away, ...robots].map(({ id, name }) => new Option(name, id, false, id === robotId)),
    );
  });
}
