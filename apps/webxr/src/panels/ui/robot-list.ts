/** The list of available robots, from which the operator chooses one. */
import type { RobotListing } from '@farpoint/protocol';
import { effect } from '@preact/signals-core';
import type { LinkState } from '../../state/link-state.ts';
import { texts } from '../../words/language.ts';
import { emptyListWords } from '../../words/robots-words.ts';
import { elements } from './elements.ts';

/** The list of robots in the bar. It shows the chosen robot, and switches to another one in a single action. */
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

export function showRobotList(
  { robots, signaling, host }: LinkState,
  onChoose: (robotId: string) => void,
): void {
  effect(() => {
    const { robotList, robotsEmpty } = elements;
    const { activeElement } = document;
    const focused = activeElement instanceof HTMLElement ? activeElement.dataset.robot : '';
    robotList.replaceChildren(...robots.value.map((robot) => itemOf(robot, onChoose)));
    // Restores the focus to the same robot's button.
    for (const button of robotList.querySelectorAll('button')) {
      if (button.dataset.robot === focused) button.focus();
    }
    robotsEmpty.hidden = robots.value.length > 0;
    const words = emptyListWords(signaling.value, host);
    robotsEmpty.textContent = words.text;
    robotsEmpty.dataset.tone = words.tone;
  });
}

function itemOf(robot: RobotListing, onChoose: (robotId: string) => void): HTMLLIElement {
  const button = document.createElement('button');
  button.dataset.robot = robot.id;
  const name = document.createElement('span');
  name.textContent = robot.name;
  const id = document.createElement('small');
  id.textContent = robot.id;
  button.append(name, id);
  button.addEventListener('click', () => onChoose(robot.id));
  const item = document.createElement('li');
  item.append(button);
  return item;
}
