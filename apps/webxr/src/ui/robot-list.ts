import type { RobotListing } from '@farpoint/protocol';
import { elements } from './elements.ts';

/** Shows who is here; keeps the focus where it was. */
export function showRobots(robots: readonly RobotListing[], onChoose: (robotId: string) => void): void {
  const { robotList, robotsEmpty } = elements;
  const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.robot : '';
  robotList.replaceChildren(
    ...robots.map((robot) => {
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
    }),
  );
  for (const button of robotList.querySelectorAll('button')) {
    if (button.dataset.robot === focused) button.focus();
  }
  robotsEmpty.hidden = robots.length > 0;
}
