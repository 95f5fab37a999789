/** The list of available robots, from which the operator chooses one. */
import type { RobotListing } from '@farpoint/protocol';
import { effect } from '@preact/signals-core';
import type { LinkState } from '../../state/link-state.ts';
import { elements } from './elements.ts';

export function showRobotList({ robots }: LinkState, onChoose: (robotId: string) => void): void {
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
