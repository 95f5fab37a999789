/** The list of available robots, from which the operator chooses one: found, and looked through by arrow keys. */
import { computed, effect, signal } from '@preact/signals-core';
import type { LastPictures } from '../../ground/pictures/last-pictures.ts';
import { MOST_CELLS, pageParameters, wallAddress } from '../../ground/wall/wall-settings.ts';
import type { LinkState } from '../../state/link-state.ts';
import { steady } from '../../state/sampler.ts';
import { isSearched, type ListedRobot, listedRobots } from '../../words/fleet-words.ts';
import { texts } from '../../words/language.ts';
import { emptyListWords } from '../../words/robots-words.ts';
import { isInWall } from './answer-wall.ts';
import { elements } from './elements.ts';
import { RobotCard } from './robot-card.ts';

/** How often the ages of pictures are said anew, ms. Chosen: they are said in minutes. */
const AGE_MS = 10_000;

export function showRobotList(
  link: LinkState,
  pictures: Pick<LastPictures, 'of'>,
  onChoose: (robotId: string) => void,
): void {
  const { robots, statuses, signaling, host } = link;
  const search = signal('');
  const found = steady(
    computed(() =>
      listedRobots({
        robots: robots.value,
        statuses: statuses.value,
        search: search.value,
        unixMs: Date.now(),
      }),
    ),
  );
  const { robotList, robotsEmpty } = elements;
  const cards = new Map<string, RobotCard>();
  const parts = searchParts((text) => {
    search.value = text;
  });
  parts.field.addEventListener('keydown', ({ code }) => {
    const [only, another] = found.peek();
    if (code === 'Enter' && only !== undefined && another === undefined) onChoose(only.id);
  });
  robotList.before(parts.row);
  robotList.after(parts.wall);
  effect(() => {
    showCards(cards, found.value, pictures, onChoose);
    showParts(parts, robots.value.length, found.value);
    robotsEmpty.hidden = robots.value.length > 0;
    const words = emptyListWords(signaling.value, host);
    robotsEmpty.textContent = words.text;
    robotsEmpty.dataset.tone = words.tone;
  });
  // Pictures have been taken while another robot was shown.
  effect(() => {
    if (link.connected.value) return;
    for (const [id, card] of cards) card.showPicture(pictures.of(id), Date.now());
  });
  setInterval(() => {
    if (link.connected.peek()) return;
    for (const card of cards.values()) card.showAge(Date.now());
  }, AGE_MS);
  elements.robots.addEventListener('keydown', moveByArrows);
}

/** Makes, changes and moves only what is not as it should be: a list of hundreds changes all the time. */
function showCards(
  cards: Map<string, RobotCard>,
  robots: readonly ListedRobot[],
  pictures: Pick<LastPictures, 'of'>,
  onChoose: (robotId: string) => void,
): void {
  const { robotList } = elements;
  const focused = document.activeElement;
  const wanted = new Set(robots.map(({ id }) => id));
  for (const [id, card] of cards) {
    if (wanted.has(id)) continue;
    card.element.remove();
    cards.delete(id);
  }
  for (const [i, robot] of robots.entries()) {
    let card = cards.get(robot.id);
    if (card === undefined) {
      card = new RobotCard(robot.id, onChoose);
      card.showPicture(pictures.of(robot.id), Date.now());
      cards.set(robot.id, card);
    }
    card.show(robot);
    const place = robotList.children[i] ?? null;
    if (place !== card.element) robotList.insertBefore(card.element, place);
  }
  // A card that was moved has lost the focus.
  if (focused instanceof HTMLElement && focused !== document.activeElement && robotList.contains(focused))
    focused.focus();
}

interface SearchParts {
  readonly row: HTMLElement;
  readonly field: HTMLInputElement;
  readonly count: HTMLElement;
  /** Leads to the robots of the list side by side. */
  readonly wall: HTMLAnchorElement;
}

function searchParts(onSearch: (text: string) => void): SearchParts {
  const [row, field, count] = [
    document.createElement('div'),
    document.createElement('input'),
    document.createElement('span'),
  ];
  row.id = 'robots-search';
  row.hidden = true;
  field.type = 'search';
  field.maxLength = 64;
  field.autocomplete = 'off';
  field.addEventListener('input', () => onSearch(field.value));
  count.role = 'status';
  row.append(field, count);
  const wall = document.createElement('a');
  wall.id = 'robots-wall';
  return { row, field, count, wall };
}

function showParts(
  { row, field, count, wall }: SearchParts,
  all: number,
  found: readonly ListedRobot[],
): void {
  const { fleet, wall: said } = texts();
  row.hidden = !isSearched(all) && field.value === '';
  field.placeholder = fleet.search;
  field.ariaLabel = fleet.search;
  count.textContent = fleet.found(found.length, all);
  wall.hidden = found.length < 2 || isInWall();
  wall.textContent = said.link;
  wall.href = wallAddress(
    found.slice(0, MOST_CELLS).map(({ id }) => id),
    pageParameters(new URLSearchParams(window.location.search)),
  );
}

/** Arrows go from robot to robot, and from the search field to the first. */
function moveByArrows(event: KeyboardEvent): void {
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.code];
  if (step === undefined) return;
  const buttons = [...elements.robotList.querySelectorAll('button')];
  const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
  const next = buttons[Math.max(0, at + step)];
  if (next === undefined) return;
  event.preventDefault();
  next.focus();
}
