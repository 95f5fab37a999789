/** The bar's list of robots: the one that is connected to, and in one action another. */
import type { RobotListing } from '@farpoint/protocol';
import { elements } from './elements.ts';

let shownRobots: readonly RobotListing[] | null = null;
let shownId: string | null = null;

export function initRobotSwitcher(onChoose: (robotId: string) => void): void {
  const { robotSwitch } = elements;
  robotSwitch.addEventListener('change', () => {
    onChoose(robotSwitch.value);
    // The arrow keys drive again.
    robotSwitch.blur();
  });
}

/** @param robotId the robot that is chosen; `null` hides the list, and so does having no other to choose */
export function showRobotSwitcher(robots: readonly RobotListing[], robotId: string | null): void {
  const { robotSwitch } = elements;
  robotSwitch.hidden = robotId === null || !robots.some(({ id }) => id !== robotId);
  // Only what has changed: a list that is built anew closes under the hand that holds it open.
  if (robotId === null || (robots === shownRobots && robotId === shownId)) return;
  shownRobots = robots;
  shownId = robotId;
  const away = robots.some(({ id }) => id === robotId) ? [] : [{ id: robotId, name: `${robotId} (away)` }];
  robotSwitch.replaceChildren(
    ...[...away, ...robots].map(({ id, name }) => new Option(name, id, false, id === robotId)),
  );
}
