/** The pages of the headset's menu: what can be chosen now, and what each choice does. Pure. */
import type { LeaseState, RobotListing } from '@farpoint/operator';
import { barWords } from '../../robot-commands/command-words.ts';
import type { ShownCommand } from '../../robot-commands/commands-state.ts';
import { menuWords } from '../../status/headset-menu-words.ts';
import { HEADSET_VIEW_WORDS } from '../../status/headset-words.ts';
import { HEADSET_VIEWS, type HeadsetView } from '../rig-pose.ts';
import type { ConsoleActions } from './console-actions.ts';

export type MenuPageName = 'main' | 'robots' | 'people' | 'views' | 'cameras' | 'commands';

/** A camera that can be shown or hidden. */
export interface MenuCamera {
  readonly kind: 'video' | 'pictures';
  readonly index: number;
  readonly name: string;
  readonly on: boolean;
}

export interface MenuFacts {
  readonly page: MenuPageName;
  /** Which of the robots, of the people, or of the robot's commands, is listed first. */
  readonly first: number;
  /** The state of the link in one line. */
  readonly link: string;
  readonly live: boolean;
  readonly latched: boolean;
  readonly robots: readonly RobotListing[];
  readonly chosenRobotId: string | null;
  readonly holder: LeaseState['holder'];
  readonly mayTake: boolean;
  /** Another operator asks for the drive or offers it; `null` if none does. */
  readonly asked: { readonly id: number; readonly accept: string; readonly refuse: string } | null;
  readonly mayAsk: boolean;
  /** Who may be offered the drive, by the robot's number of the session. */
  readonly offerable: readonly { readonly number: number; readonly text: string }[];
  /** What this operator has asked for or offered, and how it is taken back; `null` if nothing waits. */
  readonly waiting: { readonly id: number; readonly takeBack: string } | null;
  readonly view: HeadsetView;
  readonly cameras: readonly MenuCamera[];
  readonly commands: readonly Pick<ShownCommand, 'id' | 'text' | 'bar' | 'armed'>[];
  readonly readings: boolean;
  /** The operator's own room is behind the scene. */
  readonly passthrough: boolean;
}

export interface MenuItem {
  readonly text: string;
  /** `null`: it only says something. */
  readonly choice: Choice | null;
  readonly tone?: 'bad' | 'chosen';
}

export type Choice =
  | { readonly do: (actions: ConsoleActions) => void; readonly closes: boolean }
  | { readonly open: MenuPageName; readonly first?: number };

export interface MenuPage {
  readonly title: string;
  readonly items: readonly MenuItem[];
}

/** More robots, people or commands than these take further pages. */
export const ENTRIES_A_PAGE = 6;

export function menuPage(facts: MenuFacts): MenuPage {
  switch (facts.page) {
    case 'main':
      return { title: menuWords.title, items: mainItems(facts) };
    case 'robots':
      return { title: menuWords.robots, items: robotItems(facts) };
    case 'people':
      return { title: menuWords.offerTo, items: [...offerItems(facts), back] };
    case 'views':
      return { title: menuWords.view, items: [...viewItems(facts), back] };
    case 'cameras':
      return { title: menuWords.cameras, items: [...cameraItems(facts), back] };
    case 'commands':
      return { title: menuWords.commands, items: [...commandItems(facts), back] };
  }
}

const back: MenuItem = { text: menuWords.back, choice: { open: 'main' } };

function act(text: string, work: (actions: ConsoleActions) => void, closes = true): MenuItem {
  return { text, choice: { do: work, closes } };
}

function mainItems(facts: MenuFacts): MenuItem[] {
  const { live, view, cameras, commands, readings, holder, mayTake, chosenRobotId, passthrough } = facts;
  const lease =
    holder === 'you'
      ? [act(menuWords.handBack, (actions) => actions.handBack())]
      : mayTake
        ? [act(menuWords.takeOver, (actions) => actions.takeOver())]
        : [];
  return [
    ...(chosenRobotId === null ? [] : [stopItem(facts)]),
    ...(live ? peopleItems(facts) : []),
    { text: chosenRobotId === null ? menuWords.choose : menuWords.change, choice: { open: 'robots' } },
    { text: `${menuWords.view}: ${HEADSET_VIEW_WORDS[view].toLowerCase()}`, choice: { open: 'views' } },
    ...(cameras.length === 0 ? [] : [{ text: menuWords.cameras, choice: { open: 'cameras' } } as const]),
    ...(commands.length === 0 ? [] : [{ text: menuWords.commands, choice: { open: 'commands' } } as const]),
    act(menuWords.readings(readings), (actions) => actions.toggleReadings(), false),
    ...(live ? lease : []),
    ...(live ? [act(menuWords.latency, (actions) => actions.testLatency())] : []),
    act(menuWords.recentre, (actions) => actions.recentre()),
    act(menuWords.leave(passthrough), (actions) => actions.leave()),
    act(menuWords.close, () => {}),
  ];
}

function peopleItems({ asked, mayAsk, offerable, waiting }: MenuFacts): MenuItem[] {
  if (asked !== null) {
    const { id, accept, refuse } = asked;
    return [
      act(accept, (actions) => actions.answer(id, true)),
      act(refuse, (actions) => actions.answer(id, false)),
    ];
  }
  if (waiting !== null) return [act(waiting.takeBack, (actions) => actions.withdraw(waiting.id))];
  if (mayAsk) return [act(menuWords.askToDrive, (actions) => actions.askToDrive())];
  return offerable.length === 0 ? [] : [{ text: menuWords.offer, choice: { open: 'people' } }];
}

function offerItems({ offerable, first }: MenuFacts): MenuItem[] {
  const { shown, more } = pageOf(offerable, first);
  return [
    ...(offerable.length === 0 ? [{ text: menuWords.nobodyToOffer, choice: null }] : []),
    ...shown.map(({ number, text }) => act(text, (actions) => actions.offerDrive(number))),
    ...(more === null
      ? []
      : [{ text: menuWords.morePeople, choice: { open: 'people', first: more } } as const]),
  ];
}

function stopItem({ latched }: MenuFacts): MenuItem {
  const text = latched ? menuWords.stopAgain : menuWords.stop;
  return { text, choice: { do: (actions) => actions.stop(), closes: true }, tone: 'bad' };
}

function robotItems({ robots, first: wanted, chosenRobotId, link }: MenuFacts): MenuItem[] {
  const { shown, more } = pageOf(robots, wanted);
  return [
    ...(chosenRobotId === null || robots.length === 0 ? [{ text: link, choice: null }] : []),
    ...(robots.length === 0 ? [{ text: menuWords.noRobot, choice: null }] : []),
    ...shown.map(({ id, name }): MenuItem => {
      const isChosen = id === chosenRobotId;
      return { ...act(name, (actions) => actions.choose(id)), ...(isChosen ? { tone: 'chosen' } : {}) };
    }),
    ...(more === null ? [] : [{ text: menuWords.more, choice: { open: 'robots', first: more } } as const]),
    // It stays open: whoever has no robot needs one.
    ...(chosenRobotId === null ? [] : [act(menuWords.disconnect, (actions) => actions.disconnect(), false)]),
    back,
  ];
}

/** @returns those on the page that begins there, and where the next one begins; `null` if they are all on one */
function pageOf<T>(all: readonly T[], wanted: number): { shown: readonly T[]; more: number | null } {
  const first = wanted < all.length ? wanted : 0;
  const shown = all.slice(first, first + ENTRIES_A_PAGE);
  return { shown, more: all.length > ENTRIES_A_PAGE ? first + ENTRIES_A_PAGE : null };
}

/** It stays open: some take a second press, and a notice says what becomes of them. */
function commandItems({ commands, first }: MenuFacts): MenuItem[] {
  const { shown, more } = pageOf(commands, first);
  return [
    ...shown.map(({ id, text, bar, armed }): MenuItem => {
      if (bar !== null) return { text: menuWords.barred(text, barWords(bar)), choice: null };
      const item = act(text, (actions) => actions.pressCommand(id), false);
      return armed ? { ...item, tone: 'chosen' } : item;
    }),
    ...(more === null
      ? []
      : [{ text: menuWords.moreCommands, choice: { open: 'commands', first: more } } as const]),
  ];
}

function viewItems({ view }: MenuFacts): MenuItem[] {
  return HEADSET_VIEWS.map((each): MenuItem => {
    const item = act(HEADSET_VIEW_WORDS[each], (actions) => actions.show(each));
    return each === view ? { ...item, tone: 'chosen' } : item;
  });
}

function cameraItems({ cameras }: MenuFacts): MenuItem[] {
  return cameras.map(({ kind, index, name, on }) => {
    const toggle = (actions: ConsoleActions) =>
      kind === 'video' ? actions.toggleVideo(index) : actions.togglePictures(index);
    return act(menuWords.camera(name, on), toggle, false);
  });
}
