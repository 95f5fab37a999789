/** The list of available robots, from which the operator chooses one: what each does, found and sorted. */
import { computed, effect, signal } from '@preact/signals-core';
import type { LinkState } from '../state/link-state.ts';
import { steady } from '../state/steady.ts';
import {
  FLEET_ORDERS,
  type FleetOrder,
  fleetOrderWords,
  foundWords,
  type ListedRobot,
  listedRobots,
  SEARCHED_FROM,
  seenWords,
} from '../status/fleet-words.ts';
import { missingRobotWords } from '../status/robots-words.ts';
import type { LastPicture, LastPictures } from '../view/last-pictures.ts';
import { isInWall } from '../wall/answer-wall.ts';
import { MOST_CELLS, readWallSettings, wallAddress } from '../wall/wall-settings.ts';
import { elements } from './elements.ts';

/** How often the ages of pictures are said anew, ms. */
const AGE_MS = 10_000;

export function showRobotList(
  link: LinkState,
  pictures: Pick<LastPictures<HTMLCanvasElement>, 'of'>,
  onChoose: (robotId: string) => void,
): void {
  const { robots, ready, missingRobotId, statuses } = link;
  const { search, order } = findControls();
  const listed = steady(
    computed(() =>
      listedRobots({
        ...{ robots: robots.value, statuses: statuses.value },
        ...{ order: order.value, search: search.value },
      }),
    ),
  );
  effect(() => {
    const { robotList, robotsEmpty, robotsFind, robotsFound, robotsWall } = elements;
    const { activeElement } = document;
    const focused = activeElement instanceof HTMLElement ? activeElement.dataset.robot : '';
    robotList.replaceChildren(...listed.value.map((robot) => itemOf(robot, pictures.of(robot.id), onChoose)));
    // Restores the focus to the same robot's button.
    for (const button of robotList.querySelectorAll('button')) {
      if (button.dataset.robot === focused) button.focus();
    }
    robotsWall.hidden = robots.value.length < 2 || isInWall();
    robotsWall.href = wallAddress(
      robots.value.slice(0, MOST_CELLS).map(({ id }) => id),
      pageParameters(),
    );
    robotsFind.hidden = robots.value.length < SEARCHED_FROM;
    robotsFound.textContent = foundWords(listed.value.length, robots.value.length);
    // While the service does not let this page in, nobody knows which robots there are.
    robotsEmpty.hidden = robots.value.length > 0 || !ready.value || missingRobotId.value !== null;
  });
  setInterval(() => {
    for (const age of elements.robotList.querySelectorAll<HTMLElement>('.seen small')) sayAge(age);
  }, AGE_MS);
  effect(() => {
    const { robotsMissing } = elements;
    const id = missingRobotId.value;
    robotsMissing.hidden = id === null;
    robotsMissing.textContent = id === null ? '' : missingRobotWords(id, robots.value.length);
  });
}

/** What this page's address has for each page of a wall. */
function pageParameters(): URLSearchParams {
  return readWallSettings(new URLSearchParams(window.location.search)).forPages;
}

function sayAge(age: HTMLElement): void {
  age.textContent = seenWords(performance.now() - Number(age.dataset.drawnMs));
}

function findControls() {
  const { robotsSearch, robotsOrder } = elements;
  const [search, order] = [signal(''), signal<FleetOrder>('name')];
  robotsOrder.append(...FLEET_ORDERS.map((each) => new Option(fleetOrderWords[each], each)));
  robotsOrder.addEventListener('change', () => {
    order.value = FLEET_ORDERS.find((each) => each === robotsOrder.value) ?? 'name';
  });
  robotsSearch.addEventListener('input', () => {
    search.value = robotsSearch.value;
  });
  return { search, order };
}

function itemOf(
  { id, name, words }: ListedRobot,
  last: LastPicture<HTMLCanvasElement> | null,
  onChoose: (robotId: string) => void,
): HTMLLIElement {
  const button = document.createElement('button');
  button.dataset.robot = id;
  const heading = document.createElement('span');
  heading.textContent = name;
  const small = document.createElement('small');
  small.textContent = id;
  button.append(heading, small);
  if (words !== null) {
    const status = document.createElement('span');
    status.className = 'status';
    for (const { text, tone } of words) {
      const word = document.createElement('span');
      word.textContent = text;
      word.dataset.tone = tone;
      status.append(word, ' ');
    }
    button.append(status);
  }
  if (last !== null) {
    const figure = document.createElement('span');
    figure.className = 'seen';
    const age = document.createElement('small');
    age.dataset.drawnMs = String(last.drawnMs);
    sayAge(age);
    last.picture.ariaHidden = 'true';
    figure.append(last.picture, age);
    button.append(figure);
  }
  button.addEventListener('click', () => onChoose(id));
  const item = document.createElement('li');
  item.append(button);
  return item;
}
